#include "preprocess/partition/grid_triangle.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <tuple>

#include "shaders/shared/shading.h"

namespace farcell {
namespace {

using Vector = std::array<int64_t, 3>;

Vector difference(GridPoint a, GridPoint b) { return {int64_t{a.x} - b.x, int64_t{a.y} - b.y, int64_t{a.z} - b.z}; }

// The nearest integer to a rational; halves go up. denominator > 0.
int64_t roundedQuotient(int64_t numerator, int64_t denominator) {
  const int64_t twice = 2 * numerator + denominator;
  const int64_t quotient = twice / (2 * denominator);
  return twice % (2 * denominator) < 0 ? quotient - 1 : quotient;
}

uint32_t mixColours(uint32_t a, uint32_t b, double t) {
  uint32_t result = 0;
  for (int shift = 0; shift < 24; shift += 8) {
    const double from = a >> shift & 255, to = b >> shift & 255;
    result |= static_cast<uint32_t>(std::floor(from + (to - from) * t + 0.5)) << shift;
  }
  return result;
}

uint32_t mixNormals(uint32_t a, uint32_t b, double t) {
  if (a == b) return a;
  return packNormal(unpackNormal(a) * static_cast<float>(1 - t) + unpackNormal(b) * static_cast<float>(t));
}

glm::vec2 mixCoordinates(glm::vec2 a, glm::vec2 b, double t) {
  return glm::vec2(glm::dvec2(a) + (glm::dvec2(b) - glm::dvec2(a)) * t);
}

// Where the edge a-b meets the plane. Swapped ends give the same corner.
GridCorner cutEdge(GridCorner a, GridCorner b, int axis, int32_t plane) {
  if (a.position[axis] > b.position[axis]) std::swap(a, b);
  const int64_t below = int64_t{plane} - a.position[axis];
  const int64_t above = int64_t{b.position[axis]} - plane;
  const double t = static_cast<double>(below) / static_cast<double>(below + above);
  GridCorner cut{a.position, mixColours(a.colour, b.colour, t), mixNormals(a.normal, b.normal, t),
                 mixCoordinates(a.coordinates, b.coordinates, t)};
  for (int other = 0; other < 3; ++other)
    cut.position[other] =
        static_cast<int32_t>(roundedQuotient(a.position[other] * above + b.position[other] * below, below + above));
  cut.position[axis] = plane;
  return cut;
}

// Rounding may bring corners together; a polygon of fewer than three has no area.
void push(GridPolygon& polygon, const GridCorner& corner) {
  if (polygon.count > 0 && polygon.corners[polygon.count - 1].position == corner.position) return;
  if (polygon.count == GridPolygon::kMaxCorners)
    return;  // not convex by more than rounding: cannot come from a triangle
  polygon.corners[polygon.count++] = corner;
}

void close(GridPolygon& polygon) {
  while (polygon.count > 1 && polygon.corners[polygon.count - 1].position == polygon.corners[0].position)
    --polygon.count;
  if (polygon.count < 3) polygon.count = 0;
}

}  // namespace

GridBox boxOf(const GridTriangle& triangle) {
  GridBox box;
  for (const GridPoint& corner : triangle.corners) box.include(corner);
  return box;
}

bool isDegenerate(const GridTriangle& triangle) {
  const Vector u = difference(triangle.corners[1], triangle.corners[0]);
  const Vector v = difference(triangle.corners[2], triangle.corners[0]);
  return u[1] * v[2] == u[2] * v[1] && u[2] * v[0] == u[0] * v[2] && u[0] * v[1] == u[1] * v[0];
}

GridPolygon polygonOf(const GridTriangle& triangle, const TriangleTexture& texture) {
  GridPolygon polygon;
  for (int k = 0; k < 3; ++k)
    polygon.corners[k] = {triangle.corners[k], triangle.colours[k], triangle.normals[k], texture.coordinates[k]};
  polygon.count = 3;
  polygon.texture = texture.texture;
  return polygon;
}

GridBox boxOf(const GridPolygon& polygon) {
  GridBox box;
  for (int i = 0; i < polygon.count; ++i) box.include(polygon.corners[i].position);
  return box;
}

void appendTriangles(const GridPolygon& polygon, GridTriangles& out) {
  for (int i = 2; i < polygon.count; ++i) {
    const GridCorner &a = polygon.corners[0], &b = polygon.corners[i - 1], &c = polygon.corners[i];
    const GridTriangle part{
        {a.position, b.position, c.position}, {a.colour, b.colour, c.colour}, {a.normal, b.normal, c.normal}};
    if (isDegenerate(part)) continue;
    out.add(part, {polygon.texture, {a.coordinates, b.coordinates, c.coordinates}});
  }
}

CutPolygon cutAt(const GridPolygon& polygon, int axis, int32_t plane) {
  CutPolygon cut;
  cut.low.texture = cut.high.texture = polygon.texture;
  const GridBox box = boxOf(polygon);
  if (box.min[axis] >= plane) cut.high = polygon;
  if (box.min[axis] >= plane) return cut;
  if (box.max[axis] <= plane) cut.low = polygon;
  if (box.max[axis] <= plane) return cut;
  for (int i = 0; i < polygon.count; ++i) {
    const GridCorner& corner = polygon.corners[i];
    const GridCorner& next = polygon.corners[(i + 1) % polygon.count];
    const int32_t side = corner.position[axis], nextSide = next.position[axis];
    if (side <= plane) push(cut.low, corner);
    if (side >= plane) push(cut.high, corner);
    if ((side < plane && nextSide > plane) || (side > plane && nextSide < plane)) {
      const GridCorner added = cutEdge(corner, next, axis, plane);
      push(cut.low, added);
      push(cut.high, added);
    }
  }
  close(cut.low);
  close(cut.high);
  return cut;
}

uint32_t packNormal(glm::vec3 normal) {
  const float length = glm::length(normal);
  if (!(length > 0)) return 0;
  const glm::vec2 p = shared::octahedralFromUnit(normal / length);
  const auto snorm = [](float value) {
    return static_cast<uint16_t>(static_cast<int16_t>(std::lround(std::clamp(value, -1.0f, 1.0f) * 32767.0f)));
  };
  return snorm(p.x) | static_cast<uint32_t>(snorm(p.y)) << 16;
}

glm::vec3 unpackNormal(uint32_t packed) {
  const auto component = [](uint32_t bits) { return static_cast<float>(static_cast<int16_t>(bits)) / 32767.0f; };
  return shared::unitFromOctahedral(glm::vec2(component(packed & 0xffff), component(packed >> 16)));
}

}  // namespace farcell
