// The same cameras under other suns: the member "suns" of report.json, suns.csv, and a table to read.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "cache/schema/model.h"
#include "tools/evaluate/report/entry.h"

namespace farcell {

struct SunEntries {
  Sun sun;
  std::vector<Entry> entries;  // of all cameras, with their ratios
};

// [{azimuthDeg, elevationDeg, renderers: {NAME: {ratioToFull1spp, worstRatio, cameras}}}]
nlohmann::ordered_json sunsJson(const std::vector<SunEntries>& suns);
// One line a sun, camera and renderer.
std::string sunsCsv(const std::vector<SunEntries>& suns);
// One line a renderer, over all suns and cameras: its mean ratio, that under the best and the worst sun. Empty without
// suns.
std::string sunsText(const std::vector<SunEntries>& suns);

}  // namespace farcell
