// Models for the tests of the experiment.
#pragma once

#include <cmath>
#include <glm/geometric.hpp>
#include <random>
#include <vector>

#include "tests/bench/wscg2010/scene/scene.h"

namespace farcell::wscg::test {

inline Triangle triangleOf(glm::vec3 a, glm::vec3 b, glm::vec3 c, uint32_t colour = 0xc8c8c8) {
  return {{a, b, c}, {colour, colour, colour}, {}};
}

// A closed sphere of 8 * 4^splits triangles whose radius varies by `bumps`.
inline std::vector<Triangle> bumpySphere(int splits, float bumps) {
  std::vector<Triangle> faces;
  for (int octant = 0; octant < 8; ++octant)
    faces.push_back(triangleOf(glm::vec3(octant & 1 ? 1 : -1, 0, 0), glm::vec3(0, octant & 2 ? 1 : -1, 0),
                               glm::vec3(0, 0, octant & 4 ? 1 : -1)));
  for (int split = 0; split < splits; ++split) {
    std::vector<Triangle> finer;
    for (const Triangle& face : faces) {
      const auto& [a, b, c] = face.corners;
      const glm::vec3 ab = glm::normalize(a + b), bc = glm::normalize(b + c), ca = glm::normalize(c + a);
      for (const Triangle& part :
           {triangleOf(a, ab, ca), triangleOf(ab, b, bc), triangleOf(ca, bc, c), triangleOf(ab, bc, ca)})
        finer.push_back(part);
    }
    faces = finer;
  }
  for (Triangle& face : faces)
    for (glm::vec3& p : face.corners)
      p *= 1 + bumps * std::sin(7 * p.x + 1) * std::sin(6 * p.y + 2) * std::sin(8 * p.z + 3);
  return faces;
}

// Triangles of all sizes up to the whole model's, one colour each.
inline std::vector<Triangle> randomTriangles(uint32_t seed, int count) {
  std::mt19937 random(seed);
  const auto uniform = [&](float low, float high) { return std::uniform_real_distribution<float>(low, high)(random); };
  const auto point = [&](float reach) {
    return glm::vec3(uniform(-reach, reach), uniform(-reach, reach), uniform(-reach, reach));
  };
  std::vector<Triangle> triangles;
  for (int i = 0; i < count; ++i) {
    const glm::vec3 a = point(1);
    const float size = std::pow(10.0f, uniform(-2, 0));
    triangles.push_back(triangleOf(a, a + point(size), a + point(size), random() & 0xffffff));
  }
  return triangles;
}

}  // namespace farcell::wscg::test
