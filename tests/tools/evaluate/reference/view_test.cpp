#include "tools/evaluate/reference/view.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <glm/geometric.hpp>
#include <random>
#include <set>

namespace farcell {
namespace {

Camera lookingDownX() {
  Camera camera;
  camera.position = {10, 20, 30};
  camera.target = {11, 20, 30};
  camera.up = {0, 0, 1};
  camera.fovYRad = 1;
  return camera;
}

TEST(ReferenceView, TheImagesCentreLooksAtTheTarget) {
  const ReferenceView view = referenceView(lookingDownX(), 64, 48);
  EXPECT_NEAR(glm::length(rayDirection(view, {32, 24}) - glm::dvec3(1, 0, 0)), 0, 1e-15);
}

TEST(ReferenceView, TheTopLeftCornerIsRowZeroAndTheHalfAngleOfTheHeight) {
  const ReferenceView view = referenceView(lookingDownX(), 64, 48);
  const glm::dvec3 corner = rayDirection(view, {0, 0});
  EXPECT_NEAR(corner.z, std::tan(0.5), 1e-15) << "the top is up";
  EXPECT_NEAR(corner.y, std::tan(0.5) * 64 / 48, 1e-15) << "looking along x with z up, left is y; pixels are square";
}

TEST(ReferenceView, ScreenBoundsHoldEveryRayThroughTheBox) {
  for (uint32_t seed = 1; seed <= 300; ++seed) {
    SCOPED_TRACE(seed);
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> unit(0, 1);
    const ReferenceView view = referenceView(lookingDownX(), 40, 30);
    glm::dvec3 min, max;
    for (int axis = 0; axis < 3; ++axis) {
      min[axis] = view.eye[axis] - 3 + 6 * unit(random);
      max[axis] = min[axis] + 2 * unit(random);
    }
    const auto bounds = screenBounds(view, min, max);
    for (int i = 0; i < 200; ++i) {
      const glm::dvec3 p = min + (max - min) * glm::dvec3(unit(random), unit(random), unit(random)) - view.eye;
      const double depth = -glm::dot(p, view.axes.back);
      if (depth <= 0) continue;
      const double x = 20 + glm::dot(p, view.axes.right) / (depth * view.pixelSize);
      const double y = 15 - glm::dot(p, view.axes.up) / (depth * view.pixelSize);
      if (x < 0 || x >= 40 || y < 0 || y >= 30) continue;
      ASSERT_TRUE(bounds) << "a point of the box is seen at " << x << ", " << y;
      ASSERT_TRUE(x >= bounds->x0 && x < bounds->x1 && y >= bounds->y0 && y < bounds->y1);
      ASSERT_GE(depth, bounds->nearestDepth);
    }
  }
}

TEST(ReferenceView, BoxesBehindAndBesideAreNotSeen) {
  const ReferenceView view = referenceView(lookingDownX(), 40, 30);
  EXPECT_FALSE(screenBounds(view, {0, 19, 29}, {9, 21, 31}));
  EXPECT_FALSE(screenBounds(view, {11, 40, 29}, {12, 41, 31}));
  EXPECT_TRUE(screenBounds(view, {11, 19, 29}, {12, 21, 31}));
}

TEST(SamplePosition, EverySampleLiesInItsOwnSquare) {
  for (const int perAxis : {1, 2, 3, 8})
    for (int pixel = 0; pixel < 50; ++pixel)
      for (int index = 0; index < perAxis * perAxis; ++index) {
        const glm::dvec2 p = samplePosition(pixel, 7 * pixel, index, perAxis) * static_cast<double>(perAxis);
        ASSERT_EQ(static_cast<int>(p.x), index % perAxis);
        ASSERT_EQ(static_cast<int>(p.y), index / perAxis);
      }
}

TEST(SamplePosition, DiffersFromPixelToPixelAndIsUniform) {
  std::set<double> seen;
  double sumX = 0, sumY = 0;
  for (int y = 0; y < 50; ++y)
    for (int x = 0; x < 50; ++x) {
      const glm::dvec2 p = samplePosition(x, y, 0, 1);
      seen.insert(p.x);
      sumX += p.x;
      sumY += p.y;
    }
  EXPECT_EQ(seen.size(), 2500u);
  EXPECT_NEAR(sumX / 2500, 0.5, 0.03);  // five standard deviations of the mean
  EXPECT_NEAR(sumY / 2500, 0.5, 0.03);
}

}  // namespace
}  // namespace farcell
