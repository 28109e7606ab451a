// Where children of different depth meet.
#pragma once

#include "preprocess/lod/welded_mesh.h"

namespace farcell::lod {

// In the planes between the children an edge of one may lie along several of its neighbour's, which is cut by more
// planes: the vertices between are on the edge but for the rounding to the grid. Such slits are filled with triangles
// that have next to no area, so that the surface goes on and simplification cannot open it.
void closeSeams(WeldedMesh& mesh);

}  // namespace farcell::lod
