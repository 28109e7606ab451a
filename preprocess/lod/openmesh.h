// Reduction by OpenMesh's decimater with its quadrics: slow, one collapse at a time in the order of their errors.
#pragma once

#include <optional>

#include "preprocess/lod/reduction.h"

namespace farcell::lod {

// Nothing when OpenMesh cannot hold the mesh - an edge of three triangles, two triangles that disagree on which side is
// out - or its result misses the target or thins the picture out: all that the collapses of reduction.h are made for.
std::optional<Reduction> reduceByOpenMesh(const WeldedMesh& mesh, size_t targetTriangles);

}  // namespace farcell::lod
