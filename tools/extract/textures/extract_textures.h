// The atlases that the triangles of leaves look at, as picture files.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "cache/pack/pack_file.h"

namespace farcell {

struct TextureExtraction {
  std::vector<uint32_t> cells;      // those without textures are left out
  uint32_t level = 0;               // of the atlas: 0 the finest, each next one half its edges; at most its last
  std::string format = "png";       // or "tif"
  std::filesystem::path directory;  // made where it is missing
};

// Indices of the cells that have textures.
std::vector<uint32_t> cellsWithTextures(const Directory& directory);

// One picture for each part of a leaf's mesh that has an atlas, row 0 at the top, alpha where the surface has holes;
// leaves that look at the same atlas have the same file. Returns {"written": [{file, cell, key, part, level, width,
// height}...]}. exhausted: more than kMaxExtractedTextures.
inline constexpr uint64_t kMaxExtractedTextures = 100'000;
Result<nlohmann::ordered_json> extractTextures(const PackFile& pack, const TextureExtraction& settings);

}  // namespace farcell
