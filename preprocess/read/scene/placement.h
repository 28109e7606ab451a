// Where a mesh stands in a model that is made of several.
#pragma once

#include <glm/mat3x3.hpp>

#include "preprocess/mesh/mesh_reader.h"

namespace farcell {

// First scaled along its axes, then turned, then moved.
struct Pose {
  glm::dvec3 translation{0};
  glm::dmat3 rotation{1};
  glm::dvec3 scale{1};  // no component is zero; an odd number of negative ones is a mirror
};

class Placement {
 public:
  explicit Placement(const Pose& pose);
  // The placement that does this one first.
  Placement then(const Placement& next) const;

  // Positions in double. Normals by the inverse transpose, of unit length, or zero where there is no direction. A
  // mirror changes the order of the corners, so that the outer side stays outside.
  InputTriangle apply(const InputTriangle& triangle) const;

 private:
  glm::dmat3 linear_;
  glm::dmat3 normal_;  // inverse transpose of linear_
  glm::dvec3 translation_;
  bool isMirror_;
};

// Unit normal of the face, by the order of its corners; zero where double precision finds none.
glm::vec3 faceNormal(const InputTriangle& triangle);

}  // namespace farcell
