#include "preprocess/bake/colour_plane.h"

#include <algorithm>
#include <glm/geometric.hpp>

#include "shaders/shared/shading.h"

namespace farcell::bake {
namespace {

glm::vec3 corner(const CellSoup& chunk, size_t k, uint32_t triangle) {
  return glm::vec3(chunk.x[k][triangle], chunk.y[k][triangle], chunk.z[k][triangle]);
}

float sunOnFace(const glm::vec3 (&p)[3], glm::vec3 sun) {
  const glm::dvec3 cross = glm::cross(glm::dvec3(p[1] - p[0]), glm::dvec3(p[2] - p[0]));
  const double length = glm::length(cross);
  return length > 0 ? shared::lightFactor(glm::vec3(cross / length), sun) : shared::kAmbient;
}

}  // namespace

ColourPlane colourPlane(const Winners& winners, uint32_t triangle) {
  glm::vec3 p[3];
  double x[3], y[3];
  for (size_t k = 0; k < 3; ++k) {
    p[k] = corner(winners.chunk, k, triangle);
    x[k] = imagePosition(p[k], winners.projection.right, winners.projection);
    y[k] = imagePosition(p[k], winners.projection.up, winners.projection);
  }
  const double scale = (winners.sun ? sunOnFace(p, *winners.sun) : 1.0f) * (kColourOne / 255.0);
  const double x1 = x[1] - x[0], x2 = x[2] - x[0], y1 = y[1] - y[0], y2 = y[2] - y[0];
  const double area = x1 * y2 - x2 * y1;
  ColourPlane plane{};
  plane.originX = static_cast<float>(x[0]);
  plane.originY = static_cast<float>(y[0]);
  for (int channel = 0; channel < 3; ++channel) {
    double c[3];
    for (size_t k = 0; k < 3; ++k) c[k] = scale * (winners.chunk.colours[k][triangle] >> (8 * channel) & 0xff);
    const double c1 = c[1] - c[0], c2 = c[2] - c[0];
    plane.value[channel] = static_cast<float>(c[0]);
    plane.low[channel] = static_cast<float>(std::min({c[0], c[1], c[2]}));
    plane.high[channel] = static_cast<float>(std::max({c[0], c[1], c[2]}));
    if (area == 0) continue;
    plane.gradientX[channel] = static_cast<float>((c1 * y2 - c2 * y1) / area);
    plane.gradientY[channel] = static_cast<float>((c2 * x1 - c1 * x2) / area);
  }
  return plane;
}

}  // namespace farcell::bake
