// What `farcell build --json` and `farcell info --json` both print about a pack.
#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>

#include "cache/pack/directory.h"

namespace farcell {

// Wall time of a build's stages, in seconds.
struct BuildTimes {
  double read = 0;
  double partition = 0;
  double lod = 0;
  double bake = 0;
  double encode = 0;
  double total = 0;
};

// {input{triangles,vertices,skipped}, cells{leaf,inner}, views{baked,kept,leftOut},
//  bytes{pack,impostors,impostorsRaw,geometry}, seconds{...}, peakRssBytes}
// Times and memory are known to the build alone (a pack does not hold them: same input, same bytes); null without.
nlohmann::ordered_json buildReportJson(const Directory& directory, uint64_t packBytes, const BuildTimes* timesOrNull,
                                       const uint64_t* peakRssOrNull);

// JSON as text for stdout, two spaces an indent. Bytes that are not UTF-8 (file names may hold any) become U+FFFD.
std::string jsonText(const nlohmann::ordered_json& json);

}  // namespace farcell
