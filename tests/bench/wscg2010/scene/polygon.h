// Triangles cut by planes, as OpenGL cuts them by its view volume.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "tests/bench/wscg2010/scene/scene.h"

namespace farcell::wscg {

// Keeps the points with dot(normal, p) + offset >= 0.
struct Plane {
  glm::dvec3 normal;
  double offset;
  double side(glm::dvec3 p) const { return normal.x * p.x + normal.y * p.y + normal.z * p.z + offset; }
};

// [-half, half]^3.
std::array<Plane, 6> cubePlanes(double half);

// Appends what the planes leave of a triangle, as a fan; its normal stays. At most six planes.
void appendClipped(const Triangle& triangle, std::span<const Plane> planes, std::vector<Triangle>& out);

}  // namespace farcell::wscg
