// The full triangles of a leaf as a page.
#pragma once

#include <span>

#include "cache/pack/pages.h"
#include "cache/schema/model.h"
#include "preprocess/partition/grid_triangles.h"

namespace farcell {

// Vertices are shared wherever position, colour and normal agree; what the model does not have is left out.
GeometryPage geometryPage(std::span<const GridTriangle> triangles, GridPoint cellMin, const Model& model);

}  // namespace farcell
