#include "runtime/camera/pose.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <random>

namespace farcell {
namespace {

constexpr double kPi = std::numbers::pi;

// A pose somewhere, of a scene of that size, offset from the origin by so many sizes.
CameraPose randomPose(std::mt19937& random, double scale, double offset, glm::dvec3 up) {
  std::uniform_real_distribution<double> unit(-1, 1);
  CameraPose pose;
  pose.eye = glm::dvec3(unit(random), unit(random), unit(random)) * scale + glm::dvec3(offset * scale);
  pose.yawRad = unit(random) * 10;
  pose.pitchRad = unit(random) * kPi / 2;
  pose.distance = scale * (1.5 + unit(random));
  pose.up = up;
  return pose;
}

double horizontal(const CameraPose& pose, glm::dvec3 v) { return std::abs(glm::dot(v, pose.up)); }

TEST(Pose, turningAroundKeepsPivotAndDistanceAndNeverRolls) {
  const unsigned seed = 5;
  SCOPED_TRACE(fmt::format("seed {}", seed));
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> turn(-0.8, 0.8);
  for (const double scale : {1e-6, 1.0, 1e7})
    for (const glm::dvec3 up : {glm::dvec3(1, 0, 0), glm::dvec3(0, 1, 0), glm::dvec3(0, 0, 1)}) {
      CameraPose pose = randomPose(random, scale, 1000, up);
      const glm::dvec3 pivot = pivotOf(pose);
      const double distance = pose.distance;
      for (int i = 0; i < 500; ++i) {
        pose = orbited(pose, turn(random), turn(random));
        const CameraAxes axes = axesOf(pose);
        ASSERT_NEAR(glm::length(pose.eye - pivot) / distance, 1, 1e-9);
        ASSERT_LT(glm::length(pivotOf(pose) - pivot), 1e-9 * scale);
        ASSERT_LT(horizontal(pose, axes.right), 1e-12);
        ASSERT_GE(glm::dot(axes.up, up), -1e-12) << "upside down";
      }
    }
}

TEST(Pose, aTurnPastStraightUpOrDownStopsThere) {
  CameraPose pose;
  for (int i = 0; i < 100; ++i) pose = orbited(pose, 0, -0.1);
  EXPECT_DOUBLE_EQ(pose.pitchRad, -kPi / 2);
  const CameraAxes down = axesOf(pose);
  EXPECT_NEAR(glm::dot(down.back, pose.up), 1, 1e-12);
  EXPECT_NEAR(glm::length(down.right), 1, 1e-12);
  pose = orbited(pose, 1, 0);  // still turns about the vertical
  EXPECT_NEAR(glm::dot(axesOf(pose).right, down.right), std::cos(1.0), 1e-12);
}

TEST(Pose, aCameraAndBackLooksTheSame) {
  const unsigned seed = 6;
  SCOPED_TRACE(fmt::format("seed {}", seed));
  std::mt19937 random(seed);
  for (int i = 0; i < 300; ++i) {
    CameraPose pose =
        randomPose(random, std::pow(10, i % 13 - 6), i % 7 * 1000.0,
                   glm::normalize(glm::dvec3(i % 3 == 0, i % 3 == 1, i % 3 == 2) + glm::dvec3(i % 2) * 0.3));
    if (i % 10 == 0) pose.pitchRad = i % 20 == 0 ? kPi / 2 : -kPi / 2;
    const Camera camera = cameraOf(pose);
    const CameraAxes expected = axesOf(pose), axes = cameraAxes(camera);
    EXPECT_LT(glm::length(axes.right - expected.right), 1e-7) << i;
    EXPECT_LT(glm::length(axes.back - expected.back), 1e-7) << i;
    const CameraAxes again = axesOf(poseOf(camera));
    EXPECT_LT(glm::length(again.right - expected.right), 1e-7) << i;
    EXPECT_LT(glm::length(again.back - expected.back), 1e-7) << i;
    EXPECT_EQ(poseOf(camera).eye, pose.eye);
    EXPECT_NEAR(poseOf(camera).distance / pose.distance, 1, 1e-6) << i;
  }
}

TEST(Pose, aFileThatReachesTheEndsOfTheNumbersGivesAFinitePose) {
  for (const Camera& camera : {Camera{"a", {1e308, 0, 0}, {-1e308, 0, 0}, {0, 0, 1}, 1},
                               Camera{"b", {0, 0, 0}, {1e-300, 0, 0}, {0, 1e-200, 0}, 1},
                               Camera{"c", {0, 0, 5}, {0, 0, 0}, {0, 0, -1e300}, 1}}) {
    const CameraPose pose = poseOf(camera);
    const CameraAxes axes = axesOf(pose), expected = cameraAxes(camera);
    EXPECT_TRUE(std::isfinite(pose.distance) && pose.distance > 0) << camera.name;
    EXPECT_LT(glm::length(axes.back - expected.back), 1e-9) << camera.name;
    EXPECT_LT(glm::length(cameraAxes(cameraOf(pose)).back - expected.back), 1e-7) << camera.name;
  }
}

// Where a point lies on the screen: -1..1, y up.
glm::dvec2 onScreen(const CameraPose& pose, glm::dvec3 point, double aspect) {
  const CameraAxes axes = axesOf(pose);
  const glm::dvec3 v = point - pose.eye;
  const double halfHeight = -glm::dot(v, axes.back) * std::tan(pose.fovYRad / 2);
  return {glm::dot(v, axes.right) / (halfHeight * aspect), glm::dot(v, axes.up) / halfHeight};
}

TEST(Pose, aRayGoesThroughItsPointOfTheScreen) {
  std::mt19937 random(7);
  for (int i = 0; i < 50; ++i) {
    const CameraPose pose = randomPose(random, 10, 2, {0, 0, 1});
    const glm::dvec2 place(i / 25.0 - 1, std::sin(i * 1.0));
    const glm::dvec2 back = onScreen(pose, pose.eye + rayThrough(pose, place, 1.7) * 3.0, 1.7);
    EXPECT_LT(glm::length(back - place), 1e-9);
  }
}

TEST(Pose, goingTowardsAPointLeavesItWhereItIsOnTheScreen) {
  std::mt19937 random(8);
  for (int i = 0; i < 50; ++i) {
    const CameraPose pose = randomPose(random, 100, 3, {0, 1, 0});
    const glm::dvec3 point = pose.eye + rayThrough(pose, {0.3, -0.6}, 1.5) * 40.0;
    const CameraPose nearer = dollied(pose, point, 0.7);
    EXPECT_LT(glm::length(onScreen(nearer, point, 1.5) - glm::dvec2(0.3, -0.6)), 1e-9);
    EXPECT_NEAR(glm::length(nearer.eye - point), 28, 1e-9);
  }
}

TEST(Pose, aPanMovesThePivotByThatPartOfThePicture) {
  std::mt19937 random(9);
  const CameraPose pose = randomPose(random, 100, 3, {0, 0, 1});
  const glm::dvec3 pivot = pivotOf(pose);
  const glm::dvec2 place = onScreen(panned(pose, {0.5, -0.25}), pivot, 1);
  EXPECT_NEAR(place.x, -0.5, 1e-9);
  EXPECT_NEAR(place.y, 0.25, 1e-9);
}

// The outline of a ball is a circle on the ball; every point of it must be on the screen, and some near its edge.
TEST(Pose, fitFramesTheWholeBallAndNotMuchElse) {
  std::mt19937 random(10);
  for (const double scale : {1e-6, 1.0, 1e9})
    for (const double aspect : {0.3, 1.0, 2.5}) {
      const Sphere ball{glm::dvec3(500, -200, 30) * scale, 7 * scale};
      const CameraPose pose = fitted(randomPose(random, scale, 5, {0, 0, 1}), ball, aspect);
      const CameraAxes axes = axesOf(pose);
      const double away = glm::length(pose.eye - ball.centre);
      const double rim = ball.radius * ball.radius / away;  // from the centre, towards the eye
      const double rimRadius = std::sqrt(ball.radius * ball.radius - rim * rim);
      double outermost = 0;
      for (int i = 0; i < 360; ++i) {
        const double angle = i * kPi / 180;
        const glm::dvec3 point =
            ball.centre + axes.back * rim + (axes.right * std::cos(angle) + axes.up * std::sin(angle)) * rimRadius;
        const glm::dvec2 place = onScreen(pose, point, aspect);
        outermost = std::max({outermost, std::abs(place.x), std::abs(place.y)});
      }
      EXPECT_LT(outermost, 1);
      EXPECT_GT(outermost, 0.9);
      EXPECT_LT(glm::length(onScreen(pose, ball.centre, aspect)), 1e-6);
    }
}

}  // namespace
}  // namespace farcell
