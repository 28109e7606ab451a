// A mesh of one cell as the levels of detail are made of: a leaf's triangles, or what simplification left of the
// children's.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "cache/schema/grid.h"

namespace farcell {

struct LodMesh {
  std::vector<GridPoint> positions;  // on the model's grid
  std::vector<uint32_t> colours;     // one a position, 0x00BBGGRR; empty when the model has none
  std::vector<uint32_t> normals;     // one a position, octahedral as in GeometryPage; empty when the model has none
  std::vector<uint32_t> indices;     // three a triangle
  std::vector<uint32_t> shown{};     // one a triangle, as in GeometryPage; empty: what its corners say

  size_t triangles() const { return indices.size() / 3; }
  bool operator==(const LodMesh&) const = default;
};

}  // namespace farcell
