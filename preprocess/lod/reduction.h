// A welded mesh made smaller.
#pragma once

#include <cstdint>
#include <vector>

#include "preprocess/lod/welded_mesh.h"

namespace farcell::lod {

struct Reduction {
  std::vector<GridPoint> places;    // of the welded mesh, some moved
  std::vector<Triangle> triangles;  // places
  std::vector<uint32_t> origins;    // of each: the welded mesh's triangle that it was
  std::vector<uint32_t> targets;    // of each place: one that is near now
  size_t parts = 0, partsTaken = 0;
};

Reduction reduce(const WeldedMesh& mesh, size_t targetTriangles);

}  // namespace farcell::lod
