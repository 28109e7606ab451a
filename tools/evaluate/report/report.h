// A report as it is written: report.json (a contract with the work that reads it), report.csv, summary.csv, a table to
// read.
#pragma once

#include <glm/vec3.hpp>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "cache/pack/directory.h"
#include "tools/evaluate/report/entry.h"

namespace farcell {

// A pack that others are compared with by renderers "...@name".
struct OtherPackFacts {
  std::string name;
  std::string fileName;
  uint64_t bytes = 0;
  const Directory* directory = nullptr;
};

// How the figures were made.
struct ReportFacts {
  std::string packName;  // file name
  uint64_t packBytes = 0;
  const Directory* directory = nullptr;  // of the pack
  std::vector<OtherPackFacts> against;
  int width = 0;
  int height = 0;
  int timedFrames = 0;
  Light light;
  Colour background{};
  std::string glRenderer;
  std::string referenceKind;  // "pack" or "mesh"
  int referenceSamples = 0;
  double referenceSeconds = 0;  // all cameras
  bool complete = true;         // false: interrupted, some cameras are missing
};

// entries[] and summary{} hold what the project's contract lists and a little more; every figure is finite. A ratio
// that nothing can be said about (the baseline has no error, or nothing is seen) is null.
nlohmann::ordered_json reportJson(const ReportFacts& facts, const std::vector<Entry>& entries);
// One line an entry, the same figures under the same names.
std::string reportCsv(const std::vector<Entry>& entries);
// One line a renderer: the members of summary{} under the same names, after its own.
std::string summaryCsv(const std::vector<Entry>& entries);
std::string reportTable(const std::vector<Entry>& entries);

}  // namespace farcell
