// Textures as vertex colours: of what meshes of inner cells are made from, and where there is no room for an atlas.
#pragma once

#include <vector>

#include "preprocess/mesh/texture_sampler.h"
#include "preprocess/partition/grid_triangles.h"

namespace farcell {

// The triangles with their textures multiplied into the colours of their corners. A corner gets the mean of the texture
// over the nearest quarter of each triangle that meets there - within the triangles, since beyond them an image may
// hold anything - and of what shows there: beside a hole in the texture, of what its triangles show elsewhere;
// triangles that show nothing keep their colours. Corners of one place on the grid and on the texture (and one colour)
// keep one colour, so that they remain one vertex. REQUIRES: textures, when a triangle has one.
std::vector<GridTriangle> withTexturesAsColours(GridTriangles triangles, TextureSampler* textures);

}  // namespace farcell
