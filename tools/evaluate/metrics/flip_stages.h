// The two halves of FLIP (flip.cpp): how far colours are apart as the eye sees them, and where it sees edges and
// points.
#pragma once

#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "tools/evaluate/metrics/convolution.h"

namespace farcell {

// YCxCz without its scale and offset, which pass through every filter whose weights sum to 1: y, x - y and y - z of
// X, Y, Z relative to the white point.
struct OpponentImage {
  Plane y, cx, cz;
};
// rgb: 3 a pixel, 0-255, clamped to that.
OpponentImage opponentFromDisplay(std::span<const float> rgb, int width, int height);

// The picture through the eye's contrast sensitivity, as CIELAB with Hunt's adjustment, 1 a pixel.
std::vector<glm::vec3> perceived(const OpponentImage& image);
// [0, 1], of two colours that perceived() returns.
float colourError(const glm::vec3& a, const glm::vec3& b);

// How strongly edges and points respond, 1 a pixel, from 0 to sqrt(2).
struct Features {
  std::vector<double> edges, points;
};
Features detectFeatures(const Plane& y);

}  // namespace farcell
