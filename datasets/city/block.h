// One block: what kind it is, and everything on it.
#pragma once

#include "datasets/city/mesh.h"

namespace farcell::city {

struct BlockKey {
  int64_t x = 0;
  int64_t y = 0;
};

// The block number `index` of a square spiral around (0, 0): the first n^2 blocks are a square, or nearly.
BlockKey blockAt(uint64_t index);

// Fills `mesh` (cleared before) with the block of a city. What would go past `maxTriangles` is left out, small things
// as well as large; false then. The same arguments give the same triangles in the same order.
bool buildBlock(Mesh& mesh, uint64_t seed, BlockKey key, uint64_t maxTriangles);

}  // namespace farcell::city
