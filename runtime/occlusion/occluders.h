// The triangles of a leaf that hide most: its largest.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "cache/base/result.h"
#include "cache/pack/pack_file.h"

namespace farcell {

struct Occluder {
  std::array<GridPoint, 3> corners;
  float area = 0;  // steps^2
};

inline constexpr size_t kMostOccluders = 4096;  // of a leaf

// By falling area, then in the order of the pages. Reads the leaf's pages.
Result<std::vector<Occluder>> readOccluders(const PackFile& pack, uint32_t leaf);

}  // namespace farcell
