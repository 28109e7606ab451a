#include "datasets/city/mesh.h"

#include <cmath>

#include "cache/base/check.h"

namespace farcell::city {

uint32_t Mesh::vertex(glm::dvec3 position, Colour colour) {
  vertices_.push_back(
      {static_cast<float>(position.x), static_cast<float>(position.y), static_cast<float>(position.z), colour});
  return static_cast<uint32_t>(vertices_.size() - 1);
}

void Mesh::triangle(glm::dvec3 a, glm::dvec3 b, glm::dvec3 c, Colour colour) {
  const uint32_t first = vertex(a, colour);
  vertex(b, colour);
  vertex(c, colour);
  triangle(first, first + 1, first + 2);
}

void Mesh::quad(glm::dvec3 a, glm::dvec3 b, glm::dvec3 c, glm::dvec3 d, Colour colour) {
  const uint32_t first = vertex(a, colour);
  vertex(b, colour);
  vertex(c, colour);
  vertex(d, colour);
  triangle(first, first + 1, first + 2);
  triangle(first, first + 2, first + 3);
}

void Mesh::box(const Frame& frame, glm::dvec3 low, glm::dvec3 high, Colour colour) {
  const auto first = static_cast<uint32_t>(vertices_.size());
  for (uint32_t i = 0; i < 8; ++i)
    vertex(frame.at(i & 1 ? high.x : low.x, i & 2 ? high.y : low.y, i & 4 ? high.z : low.z), colour);
  // Front, back, right, left, top, bottom.
  constexpr uint32_t kSides[6][4] = {{4, 5, 7, 6}, {1, 0, 2, 3}, {5, 1, 3, 7},
                                     {0, 4, 6, 2}, {6, 7, 3, 2}, {0, 1, 5, 4}};
  for (const auto& side : kSides) {
    triangle(first + side[0], first + side[1], first + side[2]);
    triangle(first + side[0], first + side[2], first + side[3]);
  }
}

void Mesh::band(std::span<const glm::dvec3> from, std::span<const glm::dvec3> to, Colour fromColour, Colour toColour) {
  FARCELL_CHECK_EQ(from.size(), to.size());
  const auto count = static_cast<uint32_t>(from.size());
  const auto first = static_cast<uint32_t>(vertices_.size());
  for (const glm::dvec3 point : from) vertex(point, fromColour);
  for (const glm::dvec3 point : to) vertex(point, toColour);
  for (uint32_t i = 0; i < count; ++i) {
    const uint32_t next = (i + 1) % count;
    triangle(first + i, first + next, first + count + next);
    triangle(first + i, first + count + next, first + count + i);
  }
}

void Mesh::fan(std::span<const glm::dvec3> polygon, Colour colour) {
  const auto first = static_cast<uint32_t>(vertices_.size());
  for (const glm::dvec3 point : polygon) vertex(point, colour);
  for (uint32_t i = 2; i < polygon.size(); ++i) triangle(first, first + i - 1, first + i);
}

void Mesh::truncate(Mark mark) {
  vertices_.resize(mark.vertices);
  triangles_.resize(mark.triangles);
}

std::vector<glm::dvec3> polygonAround(glm::dvec3 centre, double radiusM, int count) {
  // Turned by products, not by the library's sine: that may differ in the last bit between machines.
  const double c = count == 6 ? 0.5 : count == 8 ? std::sqrt(0.5) : std::sqrt(0.75);
  const double s = std::sqrt(1 - c * c);
  std::vector<glm::dvec3> corners;
  glm::dvec3 arm(radiusM, 0, 0);
  for (int i = 0; i < count; ++i) {
    corners.push_back(centre + arm);
    arm = glm::dvec3(c * arm.x - s * arm.y, s * arm.x + c * arm.y, 0);
  }
  return corners;
}

}  // namespace farcell::city
