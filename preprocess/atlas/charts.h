// The parts of textures that a list of triangles looks at, as few rectangles.
#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <span>
#include <vector>

#include "preprocess/mesh/texture_sampler.h"
#include "preprocess/partition/grid_triangles.h"

namespace farcell {

// A rectangle of a texture, in its coordinates. It may reach beyond the image: repeated, mirrored or held there as the
// texture says.
struct Chart {
  uint32_t texture = kNoTexture;  // kNoTexture: white, for triangles without one
  glm::dvec2 min{0};
  glm::dvec2 size{1};
  glm::dvec2 texels{1};  // of the image, whole numbers
};

struct ChartedTriangle {
  uint32_t chart = 0;
  std::array<glm::dvec2, 3> coordinates;  // on the chart's texture, inside the chart
};

struct Charts {
  std::vector<Chart> charts;
  std::vector<ChartedTriangle> triangles;  // one for each texture
};

// Each triangle is moved by whole periods of its texture towards the image, so that what repeats is there once; then
// triangles whose rectangles share a tile of the image share a chart. Charts are made of whole tiles: leaves that look
// at nearly the same get the same charts. Numbers that are no coordinates count as TextureSampler takes them.
Charts chartsOf(std::span<const TriangleTexture> textures, const TextureSampler& sampler);

}  // namespace farcell
