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
  glm::dvec3 colour;  // lit, or albedo; [0, 1]
};

struct SyntheticView {
  uint32_t view = 0;
  int imageSize = 64;
  int samplesPerEdge = 3;    // of a texel
  bool relightable = false;  // with the mean vectors of normals; colours are albedo
};

// The view from `direction` of what lies within [-kCellGrowth, kCellGrowth]^3.
ViewImage bakeSynthetic(const std::vector<LocalTriangle>& triangles, glm::dvec3 direction, const SyntheticView& wanted);

}  // namespace farcell
