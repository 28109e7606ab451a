// Views of a pack as picture files.
#pragma once

#include <cstdint>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "cache/pack/pack_file.h"
#include "tools/extract/views/view_picture.h"

namespace farcell {

// What an extraction may make: a slip ("--cell all" of a large pack) must not fill a disk.
inline constexpr uint64_t kMaxExtractedFiles = 100'000;
inline constexpr int kMaxAtlasEdge = 16'384;

// "12", "level/x/y/z" or "all" (all that have views): indices of cells. invalidArgument for what is neither or not
// there.
Result<std::vector<uint32_t>> parseCells(const std::string& text, const Directory& directory);
// "all", or views and ranges: "0,7,12-20". Rising, each once. invalidArgument when one is not below `count`.
Result<std::vector<uint32_t>> parseViews(const std::string& text, uint32_t count);
// "colour", "coverage", "depth", "normal".
Result<ViewChannel> parseChannel(const std::string& text);

struct ExtractSettings {
  std::vector<uint32_t> cells;
  std::vector<uint32_t> views;  // rising; of a cell of fewer views those it has
  ViewChannel channel = ViewChannel::colour;
  bool full = false;                // the whole square of a view, not only the rectangle that holds anything
  bool atlas = false;               // one picture a cell: all views in a grid of whole squares, with a JSON file beside
  std::string format = "png";       // or "tif"
  std::filesystem::path directory;  // made where it is missing
};

// Returns {"written": [file...], "empty": views that hold nothing, or were left out of the pack}. A file names cell,
// key, and of one view, or each tile of an atlas: view, direction (from the cell's centre to the viewer), rectangle (in
// the picture, row 0 at the top), image (the same in the view's own square, row 0 the lowest) and depth (of value 1 and
// 255, in half sides of the cell along the direction). unsupported: normals of a pack without; exhausted: more or
// larger files than the limits above.
Result<nlohmann::ordered_json> extractViews(const PackFile& pack, const ExtractSettings& settings);

}  // namespace farcell
