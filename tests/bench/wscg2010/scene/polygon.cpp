#include "tests/bench/wscg2010/scene/polygon.h"

#include <algorithm>

#include "cache/base/check.h"

namespace farcell::wscg {
namespace {

constexpr size_t kMaxPlanes = 6;

struct Corner {
  glm::dvec3 position{0};
  glm::dvec3 colour{0};  // 0..255
};

// A triangle cut by six planes has at most nine corners.
struct Polygon {
  std::array<Corner, 3 + kMaxPlanes> corners;
  size_t count = 0;
};

glm::dvec3 unpackColour(uint32_t colour) { return glm::dvec3(colour & 255, colour >> 8 & 255, colour >> 16 & 255); }

uint32_t packColour(glm::dvec3 colour) {
  uint32_t packed = 0;
  for (int channel = 0; channel < 3; ++channel)
    packed |= static_cast<uint32_t>(std::clamp(colour[channel], 0.0, 255.0) + 0.5) << 8 * channel;
  return packed;
}

// Sutherland and Hodgman, Reentrant Polygon Clipping, 1974.
Polygon clipped(const Polygon& polygon, const Plane& plane) {
  Polygon result;
  for (size_t i = 0; i < polygon.count; ++i) {
    const Corner& corner = polygon.corners[i];
    const Corner& next = polygon.corners[(i + 1) % polygon.count];
    const double here = plane.side(corner.position), there = plane.side(next.position);
    if (here >= 0) result.corners[result.count++] = corner;
    if ((here > 0 && there < 0) || (here < 0 && there > 0)) {
      const double t = here / (here - there);
      result.corners[result.count++] = {corner.position + (next.position - corner.position) * t,
                                        corner.colour + (next.colour - corner.colour) * t};
    }
  }
  return result;
}

}  // namespace

std::array<Plane, 6> cubePlanes(double half) {
  std::array<Plane, 6> planes{};
  for (int axis = 0; axis < 3; ++axis) {
    for (const int sign : {-1, 1}) {
      Plane& plane = planes[static_cast<size_t>(2 * axis + (sign > 0 ? 1 : 0))];
      plane.normal[axis] = sign;
      plane.offset = half;
    }
  }
  return planes;
}

void appendClipped(const Triangle& triangle, std::span<const Plane> planes, std::vector<Triangle>& out) {
  FARCELL_CHECK(planes.size() <= kMaxPlanes);
  Polygon polygon;
  polygon.count = 3;
  for (size_t k = 0; k < 3; ++k)
    polygon.corners[k] = {glm::dvec3(triangle.corners[k]), unpackColour(triangle.colours[k])};
  for (const Plane& plane : planes) polygon = clipped(polygon, plane);
  for (size_t i = 2; i < polygon.count; ++i) {
    const std::array<const Corner*, 3> fan = {&polygon.corners[0], &polygon.corners[i - 1], &polygon.corners[i]};
    Triangle& part = out.emplace_back();
    part.normal = triangle.normal;
    for (size_t k = 0; k < 3; ++k) {
      part.corners[k] = glm::vec3(fan[k]->position);
      part.colours[k] = packColour(fan[k]->colour);
    }
  }
}

}  // namespace farcell::wscg
