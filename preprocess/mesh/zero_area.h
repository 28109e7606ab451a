// Whether a triangle has no area at all. Slivers have some and are kept: they hold real cities shut.
#pragma once

#include <array>
#include <cmath>
#include <glm/vec3.hpp>

namespace farcell {

// The whole test, for the rare triangles that the quick one cannot decide; finite corners.
bool hasZeroAreaExactly(const std::array<glm::dvec3, 3>& corners);

// Whether the corners are finite and the cross product of the edges (taken in double) is other than zero beyond doubt:
// nearly always. Two equal products round alike, so a difference other than zero is one; a corner that is not finite
// makes the sum so.
inline bool hasAreaPlainly(const std::array<glm::dvec3, 3>& corners) {
  const glm::dvec3 a = corners[1] - corners[0];
  const glm::dvec3 b = corners[2] - corners[0];
  const double x = a.y * b.z - a.z * b.y;
  const double y = a.z * b.x - a.x * b.z;
  const double z = a.x * b.y - a.y * b.x;
  const double sum = std::abs(x) + std::abs(y) + std::abs(z);
  return sum > 0 && std::isfinite(sum);
}

// Whether that cross product is exactly zero, at any scale: neither rounding nor underflow nor overflow of the products
// counts as zero. True for two equal corners. REQUIRES: finite corners.
inline bool hasZeroArea(const std::array<glm::dvec3, 3>& corners) {
  return !hasAreaPlainly(corners) && hasZeroAreaExactly(corners);
}

}  // namespace farcell
