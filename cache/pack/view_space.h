// The texture space of a view (shaders/shared/draw.h): what a look through it must know, whoever looks.
#pragma once

#include <glm/vec3.hpp>

#include "cache/pack/pages.h"
#include "shaders/shared/draw.h"

namespace farcell {

// A view that lies in a layer of images.
struct ResidentView {
  int layer = -1;  // -1: the view is empty, there is nothing to see
  uint32_t x0 = 0, y0 = 0, width = 0, height = 0;
  float depthMin = 0, depthMax = 0;
};

ResidentView residentView(const ViewImage& image, int layer);

// direction: of the view (Viewpoints::directions); eye: local; texel: edge, half sides; weight: where views are
// blended. An empty view is never hit.
shared::ImpostorView impostorView(const ResidentView& view, glm::dvec3 direction, double weight, glm::dvec3 eye,
                                  double texel);

}  // namespace farcell
