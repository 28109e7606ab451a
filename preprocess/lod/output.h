// From a reduction back to vertices with colours and normals.
#pragma once

#include "preprocess/lod/lod_mesh.h"
#include "preprocess/lod/reduction.h"

namespace farcell::lod {

// A corner that has moved to another place takes that vertex of the place whose colour and normal are most like its
// own, so that seams stay seams.
LodMesh outputMesh(const WeldedMesh& mesh, const Reduction& reduction);

}  // namespace farcell::lod
