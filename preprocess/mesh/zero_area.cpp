#include "preprocess/mesh/zero_area.h"

#include <algorithm>

namespace farcell {
namespace {

double largest(glm::dvec3 v) { return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)}); }

// `v` times the power of two that brings its largest component into [1, 2): no bit is lost that matters.
glm::dvec3 normalised(glm::dvec3 v) {
  const int exponent = -std::ilogb(largest(v));
  return glm::dvec3(std::scalbn(v.x, exponent), std::scalbn(v.y, exponent), std::scalbn(v.z, exponent));
}

// a d == b c, exactly (Kahan's difference of products; with components of about 1 only products that are negligible
// against the largest component's can underflow).
bool equalProducts(double a, double d, double b, double c) {
  const double product = b * c;
  const double error = std::fma(-b, c, product);
  return std::fma(a, d, -product) + error == 0;
}

}  // namespace

bool hasZeroAreaExactly(const std::array<glm::dvec3, 3>& corners) {
  // Edges of coordinates near the largest double overflow; a quarter of them does not.
  const bool huge = std::max({largest(corners[0]), largest(corners[1]), largest(corners[2])}) > 1e300;
  const double scale = huge ? 0.25 : 1.0;
  const glm::dvec3 origin = corners[0] * scale;
  glm::dvec3 a = corners[1] * scale - origin;
  glm::dvec3 b = corners[2] * scale - origin;
  if (largest(a) == 0 || largest(b) == 0) return true;
  a = normalised(a);
  b = normalised(b);
  return equalProducts(a.y, b.z, a.z, b.y) && equalProducts(a.z, b.x, a.x, b.z) && equalProducts(a.x, b.y, a.y, b.x);
}

}  // namespace farcell
