// What a cell looks like with a simplified mesh, against its full geometry: the project's own baker sees both.
#pragma once

#include "cache/schema/grid.h"
#include "preprocess/bake/view_baker.h"
#include "preprocess/lod/lod_mesh.h"

namespace farcell::bench {

struct Appearance {
  double coverage = 1;    // sum of alpha over 42 views, mesh / full
  double imageError = 0;  // mean |difference| of r, g, b over grey, 0-255, over texels that either covers
};

CellSoup cellSoup(const Grid& grid, const CellKey& cell, const LodMesh& mesh);
Appearance compare(const CellSoup& full, const CellSoup& simplified, int imageSize);

}  // namespace farcell::bench
