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
  // Opposite the edge from each corner to the next, in the one other triangle of the leaf at this edge; where there is
  // none or are several, the third corner of the occluder itself, as if another were folded onto it.
  std::array<GridPoint, 3> across;
  float area = 0;  // steps^2
};

inline constexpr size_t kMostOccluders = 4096;  // of a leaf

// Sets `across` of each by the corners of all.
void findAcross(std::vector<Occluder>& occluders);

// By falling area, then in the order of the pages. Reads the leaf's pages.
Result<std::vector<Occluder>> readOccluders(const PackFile& pack, uint32_t leaf);

}  // namespace farcell
