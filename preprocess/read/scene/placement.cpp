#include "preprocess/read/scene/placement.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace farcell {
namespace {

glm::dmat3 scaled(const glm::dmat3& matrix, glm::dvec3 scale) {
  return glm::dmat3(matrix[0] * scale.x, matrix[1] * scale.y, matrix[2] * scale.z);
}

// However long or short; zero when there is no direction.
glm::dvec3 unit(glm::dvec3 v) {
  const double largest = std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
  return largest > 0 && std::isfinite(largest) ? glm::normalize(v / largest) : glm::dvec3(0);
}

}  // namespace

Placement::Placement(const Pose& pose)
    : linear_(scaled(pose.rotation, pose.scale)),
      normal_(scaled(pose.rotation, 1.0 / pose.scale)),
      translation_(pose.translation),
      isMirror_(((pose.scale.x < 0) != (pose.scale.y < 0)) != (pose.scale.z < 0)) {}

Placement Placement::then(const Placement& next) const {
  Placement both = *this;
  both.linear_ = next.linear_ * linear_;
  both.normal_ = next.normal_ * normal_;
  both.translation_ = next.linear_ * translation_ + next.translation_;
  both.isMirror_ = isMirror_ != next.isMirror_;
  return both;
}

InputTriangle Placement::apply(const InputTriangle& triangle) const {
  InputTriangle placed = triangle;
  for (size_t i = 0; i < 3; ++i) {
    placed.positions[i] = linear_ * triangle.positions[i] + translation_;
    placed.normals[i] = glm::vec3(unit(normal_ * glm::dvec3(triangle.normals[i])));
  }
  if (!isMirror_) return placed;
  std::swap(placed.positions[1], placed.positions[2]);
  std::swap(placed.normals[1], placed.normals[2]);
  std::swap(placed.colours[1], placed.colours[2]);
  std::swap(placed.textureCoordinates[1], placed.textureCoordinates[2]);
  return placed;
}

glm::vec3 faceNormal(const InputTriangle& triangle) {
  const auto& [a, b, c] = triangle.positions;
  return glm::vec3(unit(glm::cross(unit(b - a), unit(c - a))));
}

}  // namespace farcell
