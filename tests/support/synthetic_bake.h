// Views of a few triangles, one sample at a time.
#pragma once

#include <array>
#include <glm/vec3.hpp>
#include <vector>

#include "cache/pack/pages.h"

namespace farcell {

// Cell-local corners (view_frame.h).
struct LocalTriangle {
  std::array<glm::dvec3, 3> corners;
  glm::dvec3 colour;  // lit, [0, 1]
};

// The view from `direction` of what lies within [-kCellGrowth, kCellGrowth]^3.
ViewImage bakeSynthetic(const std::vector<LocalTriangle>& triangles, glm::dvec3 direction, uint32_t view, int imageSize,
                        int samplesPerEdge);

}  // namespace farcell
