// What the tests of the glTF reader share.
#pragma once

#include <cstdlib>
#include <glm/geometric.hpp>

#include "tests/preprocess/read/read_support.h"
#include "tests/support/gltf_writer.h"
#include "tests/support/sanitized.h"

namespace farcell::test {

using nlohmann::json;

inline ReadMesh readGlb(const GltfWriter& writer) {
  const TempDirectory directory;
  return readGood(directory.write("model.glb", writer.glb()));
}

// Of the random tests; more where the variable says so.
inline int fuzzRounds() {
  const char* text = std::getenv("FARCELL_FUZZ_ROUNDS");
  return text ? std::atoi(text) : kSanitized ? 300 : 1500;
}

using Corners = std::array<glm::dvec3, 3>;

// Not collinear, and no two corners of all the triangles alike.
inline std::vector<float> cornerNumbers(size_t triangles) {
  std::vector<float> numbers;
  for (size_t i = 0; i < triangles; ++i) {
    const auto x = static_cast<float>(i);
    numbers.insert(numbers.end(), {x, 0.25f, 0, x + 0.5f, 0.125f, 0.0625f, x, 1, -x});
  }
  return numbers;
}

inline glm::dvec3 pointOf(const std::vector<float>& numbers, size_t vertex) {
  return {numbers[3 * vertex], numbers[3 * vertex + 1], numbers[3 * vertex + 2]};
}

inline std::vector<Corners> positionsOf(const ReadMesh& mesh) {
  std::vector<Corners> all;
  for (const InputTriangle& triangle : mesh.triangles) all.push_back(triangle.positions);
  return all;
}

inline void expectNear(glm::dvec3 actual, glm::dvec3 expected, double tolerance) {
  for (int i = 0; i < 3; ++i) EXPECT_NEAR(actual[i], expected[i], tolerance) << "component " << i;
}

inline std::array<int, 3> channels(uint32_t colour) {
  return {int(colour & 255), int(colour >> 8 & 255), int(colour >> 16 & 255)};
}

}  // namespace farcell::test
