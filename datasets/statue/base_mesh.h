// The coarse surface a statue grows from: corners joined where they lie at exactly the same place, edges shared.
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <memory>
#include <vector>

#include "cache/base/result.h"

namespace farcell {

// In its own unit: lengths are divided by the diagonal of the bounding box, places counted from the box's middle.
struct BaseMesh {
  glm::dvec3 middle{0};
  double diagonal = 1;

  std::vector<glm::dvec3> positions;
  std::vector<glm::dvec3> normals;  // smooth: means of the triangles around, by their areas; 0 where they cancel
  // How far the surface is rounded between the corners: 1 where the triangles around agree with the normal, 0 at
  // creases.
  std::vector<float> roundness;
  std::vector<std::array<uint8_t, 3>> colours;  // red, green, blue

  using Triangle = std::array<uint32_t, 3>;
  std::vector<Triangle> triangles;
  // Side i of a triangle goes from corner i to corner i + 1. An edge names its lower corner first; any number of
  // triangles may share it.
  std::vector<Triangle> sides;  // indices into edges
  std::vector<std::array<uint32_t, 2>> edges;
};

class BaseMeshBuilder {
 public:
  BaseMeshBuilder();
  BaseMeshBuilder(BaseMeshBuilder&&) noexcept;
  ~BaseMeshBuilder();

  // Finite corners; a triangle with two equal ones is dropped. A place met again keeps its first colour.
  // exhausted beyond 2^31 triangles.
  Result<> add(const std::array<glm::dvec3, 3>& corners, const std::array<std::array<uint8_t, 3>, 3>& colours);
  // corrupt without triangles or with a box whose diagonal is not finite.
  Result<BaseMesh> finish() &&;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace farcell
