#include "tools/evaluate/baselines/octahedral_grid.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace farcell {
namespace {

constexpr int kLast = kOctahedralEdge - 1;

}  // namespace

glm::dvec3 octahedralDirection(int frame) {
  const double ex = 2.0 * (frame % kOctahedralEdge) / kLast - 1, ey = 2.0 * (frame / kOctahedralEdge) / kLast - 1;
  const double x = (ex + ey) / 2, y = (ex - ey) / 2;
  return glm::normalize(glm::dvec3(x, y, std::max(0.0, 1 - std::abs(x) - std::abs(y))));
}

OctahedralFrames octahedralFrames(glm::dvec3 direction) {
  glm::dvec3 d = glm::normalize(direction);
  if (d.z < 0) d = d.x == 0 && d.y == 0 ? glm::dvec3(1, 0, 0) : glm::dvec3(d.x, d.y, 0);
  d /= std::abs(d.x) + std::abs(d.y) + d.z;
  const auto onGrid = [](double e) { return std::clamp((e + 1) / 2 * kLast, 0.0, double{kLast}); };
  const double gx = onGrid(d.x + d.y), gy = onGrid(d.x - d.y);
  const int x = std::min(static_cast<int>(gx), kLast - 1), y = std::min(static_cast<int>(gy), kLast - 1);
  const double fx = gx - x, fy = gy - y;
  const int first = y * kOctahedralEdge + x, aside = fx > fy ? first + 1 : first + kOctahedralEdge;
  return {{first, aside, first + kOctahedralEdge + 1}, {1 - std::max(fx, fy), std::abs(fx - fy), std::min(fx, fy)}};
}

}  // namespace farcell
