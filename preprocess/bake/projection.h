// From cell-local positions to the samples of a view (sample_image.h), in float, alike on every instruction set.
#pragma once

#include <glm/vec3.hpp>

#include "cache/schema/view_frame.h"
#include "preprocess/bake/sample_image.h"

namespace farcell::bake {

struct Projection {
  // x = dot(p, right), y = dot(p, up): sample widths from the centre; w = dot(p, toward): half sides of the cell.
  float right[3], up[3], toward[3];
  // Adding and subtracting it rounds a position to a multiple of 2^-k, where 2^k sample widths are 2^23 steps: then
  // every position, and every difference of two, is exact in a float. A step is at most 4.3e-7 half sides.
  float snap;
  float halfEdge;  // positions lie in [-halfEdge, halfEdge]
  // Of a view and its antipode one is.
  bool isAntipode;
};

Projection projectionOf(const ViewFrame& frame, const SampleImage& image);

// The rounded position of a point along right or up: the one that the rasteriser uses.
float imagePosition(glm::vec3 point, const float (&axis)[3], const Projection& projection);

}  // namespace farcell::bake
