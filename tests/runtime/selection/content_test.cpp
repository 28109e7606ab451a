#include "runtime/selection/content.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <random>

namespace farcell {
namespace {

// A root whose two children hold a box each, in a cube of `side` at `origin`.
Directory twoBoxes(glm::dvec3 origin, double side) {
  Directory directory;
  directory.model.grid = {origin, side, 16};
  constexpr int kHalf = 1 << 15;
  CellRecord root, low, high;
  low.key = {1, 0, 0, 0};
  low.content = {{0, 0, 0}, {kHalf / 2, kHalf / 2, kHalf / 4}};
  high.key = {1, 1, 1, 1};
  high.content = {{kHalf + kHalf / 2, kHalf, kHalf}, {2 * kHalf, kHalf + 100, kHalf + 200}};
  low.parent = high.parent = 0;
  root.content = low.content;
  root.content.include(high.content);
  root.firstChild = 1;
  root.childCount = 2;
  directory.cells = {root, low, high};
  directory.model.bounds = root.content;
  return directory;
}

bool inside(const Directory& directory, const GridBox& box, glm::dvec3 point) {
  const glm::dvec3 min = directory.model.grid.worldFromGrid(box.min), max = directory.model.grid.worldFromGrid(box.max);
  for (int axis = 0; axis < 3; ++axis)
    if (point[axis] < min[axis] || point[axis] > max[axis]) return false;
  return true;
}

TEST(Content, isAsFarAsTheNearestBoxOfALeaf) {
  const Directory directory = twoBoxes({1000, -50, 3}, 8);
  EXPECT_DOUBLE_EQ(distanceToContent(directory, {1000.5, -49.5, 3.2}), 0);
  EXPECT_NEAR(distanceToContent(directory, {1000.5, -49.5, 5}), 1, 1e-9);    // above the low one: it ends at 3 + 1
  EXPECT_NEAR(distanceToContent(directory, {997, -54, 3.5}), 5, 1e-9);       // 3 and 4 from its edge
  EXPECT_NEAR(distanceToContent(directory, {1010, -45.99, 7.01}), 2, 1e-2);  // beside the high one
  // Inside the root's box, but in neither of its children's.
  EXPECT_GT(distanceToContent(directory, {1003.5, -46.5, 6}), 1);
}

TEST(Content, aRayMeetsTheFirstBoxAheadThatDoesNotHoldTheEye) {
  const Directory directory = twoBoxes({0, 0, 0}, 8);
  EXPECT_NEAR(distanceAlong(directory, {1, 1, 5}, {0, 0, -1}).value_or(-1), 4, 1e-9);
  EXPECT_FALSE(distanceAlong(directory, {1, 1, 5}, {0, 0, 1}));    // away
  EXPECT_FALSE(distanceAlong(directory, {5, 1, 5}, {0, 0, -1}));   // past it
  EXPECT_FALSE(distanceAlong(directory, {1, 1, 0.5}, {0, 0, 1}));  // from inside
  const glm::dvec3 towardsHigh = glm::normalize(glm::dvec3(6.5, 4.005, 4.01) - glm::dvec3(1, 1, 0.5));
  EXPECT_NEAR(distanceAlong(directory, {1, 1, 0.5}, towardsHigh).value_or(-1),
              std::max(3 / towardsHigh.y, 3.5 / towardsHigh.z), 1e-3);
}

// Walks the ray in small steps: the first one inside a leaf's box is where the answer says.
TEST(Content, raysAgreeWithAWalkAlongThem) {
  const unsigned seed = 12;
  SCOPED_TRACE(fmt::format("seed {}", seed));
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> unit(-1, 1);
  const Directory directory = twoBoxes({-4, -4, -4}, 8);
  int met = 0;
  for (int i = 0; i < 400; ++i) {
    const glm::dvec3 eye = glm::dvec3(unit(random), unit(random), unit(random)) * 8.0;
    const glm::dvec3 direction = glm::normalize(glm::dvec3(unit(random), unit(random), unit(random)) * 2.0 - 3.0 - eye);
    double walked = -1;
    for (double t = 0; t < 30 && walked < 0; t += 0.002)
      for (const uint32_t leaf : {1u, 2u}) {
        const GridBox& box = directory.cells[leaf].content;
        if (!inside(directory, box, eye) && inside(directory, box, eye + direction * t)) walked = t;
      }
    const double told = distanceAlong(directory, eye, direction).value_or(-1);
    if (walked >= 0) {
      ++met;
      EXPECT_NEAR(told, walked, 0.0021);
    } else if (told >= 0) {  // a corner too short for the steps
      EXPECT_FALSE(inside(directory, directory.cells[1].content, eye + direction * (told + 0.01)));
    }
  }
  EXPECT_GT(met, 50);
}

TEST(Content, anEmptyModelIsInfinitelyFar) {
  EXPECT_TRUE(std::isinf(distanceToContent({}, {0, 0, 0})));
  EXPECT_FALSE(distanceAlong({}, {0, 0, 0}, {1, 0, 0}));
}

}  // namespace
}  // namespace farcell
