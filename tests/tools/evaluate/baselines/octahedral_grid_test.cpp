#include "tools/evaluate/baselines/octahedral_grid.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <random>

namespace farcell {
namespace {

TEST(OctahedralGrid, DirectionsAreUnitDistinctAndAboveTheHorizon) {
  for (int a = 0; a < kOctahedralFrames; ++a) {
    const glm::dvec3 d = octahedralDirection(a);
    EXPECT_NEAR(glm::length(d), 1, 1e-12);
    EXPECT_GE(d.z, 0);
    for (int b = 0; b < a; ++b) EXPECT_GT(glm::length(d - octahedralDirection(b)), 0.05) << a << ' ' << b;
  }
  EXPECT_LT(glm::length(octahedralDirection(0) - glm::dvec3(-1, 0, 0)), 1e-12) << "a corner lies on the horizon";
}

TEST(OctahedralGrid, AFramesOwnDirectionIsItsAlone) {
  for (int frame = 0; frame < kOctahedralFrames; ++frame) {
    const OctahedralFrames found = octahedralFrames(octahedralDirection(frame) * 7.0);
    double weight = 0;
    for (size_t k = 0; k < 3; ++k) weight += found.frames[k] == frame ? found.weights[k] : 0;
    EXPECT_NEAR(weight, 1, 1e-9) << frame;
  }
}

// Half the widest step between neighbours, about 11 degrees, bounds how far the nearest of the three is.
TEST(OctahedralGrid, TheThreeFramesLieAroundTheDirection) {
  std::mt19937 random(3);
  std::normal_distribution<double> normal;
  for (int i = 0; i < 2000; ++i) {
    const glm::dvec3 d = glm::normalize(glm::dvec3(normal(random), normal(random), std::abs(normal(random))));
    const OctahedralFrames found = octahedralFrames(d);
    double sum = 0, nearest = 9;
    for (size_t k = 0; k < 3; ++k) {
      ASSERT_GE(found.frames[k], 0);
      ASSERT_LT(found.frames[k], kOctahedralFrames);
      EXPECT_GE(found.weights[k], -1e-12);
      sum += found.weights[k];
      const double angle = std::acos(std::min(1.0, glm::dot(d, octahedralDirection(found.frames[k]))));
      EXPECT_LT(angle * 180 / std::numbers::pi, 17) << "seed 3, direction " << i;
      nearest = std::min(nearest, angle);
    }
    EXPECT_NEAR(sum, 1, 1e-12);
    EXPECT_LT(nearest * 180 / std::numbers::pi, 9);
  }
}

TEST(OctahedralGrid, BelowTheHorizonTheHorizonIsTaken) {
  const OctahedralFrames below = octahedralFrames({1, 2, -3}), on = octahedralFrames({1, 2, 0});
  EXPECT_EQ(below.frames, on.frames);
  const OctahedralFrames straightDown = octahedralFrames({0, 0, -1});
  EXPECT_GE(straightDown.frames[0], 0);
}

}  // namespace
}  // namespace farcell
