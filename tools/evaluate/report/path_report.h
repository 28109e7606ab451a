// Camera paths as they are written: the member "paths" of report.json, paths.csv, and a table to read.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <span>
#include <string>

#include "tools/evaluate/report/path_entry.h"

namespace farcell {

// [{name, stem, frames, referenceChange: [one a frame], renderers: [{renderer, class, settings, summary: {...},
// frames: {paperError: [one a frame], flicker: [...], ...}}]}]
nlohmann::ordered_json pathsJson(std::span<const PathEntry> paths);
// One line a path, renderer and frame.
std::string pathsCsv(std::span<const PathEntry> paths);
// One line a path and renderer.
std::string pathsTable(std::span<const PathEntry> paths);

}  // namespace farcell
