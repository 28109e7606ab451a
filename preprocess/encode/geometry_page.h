// The full triangles of a leaf as a page.
#pragma once

#include <array>
#include <span>

#include "cache/pack/pages.h"
#include "cache/schema/model.h"
#include "preprocess/partition/grid_triangles.h"

namespace farcell {

// Vertices are shared wherever all that they have agrees; what the model does not have is left out.
// coordinates: of each triangle's corners on the page's atlas (preprocess/atlas); empty: it has none.
GeometryPage geometryPage(std::span<const GridTriangle> triangles, GridPoint cellMin, const Model& model,
                          std::span<const std::array<uint32_t, 3>> coordinates = {});

}  // namespace farcell
