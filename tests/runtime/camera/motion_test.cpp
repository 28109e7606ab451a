#include "runtime/camera/motion.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>
#include <random>

namespace farcell {
namespace {

CameraPose poseAt(glm::dvec3 eye, double distance = 10) {
  CameraPose pose;
  pose.eye = eye;
  pose.distance = distance;
  return pose;
}

TEST(Motion, flyingGoesAlongTheVelocityBySpeedTimesTime) {
  const glm::dvec3 velocity(3, -1, 0.5);
  CameraMotion motion(poseAt({100, 0, 0}));
  for (int i = 0; i < 100; ++i) motion.advance(0.02, velocity, Anchor::eye);
  EXPECT_LT(glm::length(motion.goal().eye - (glm::dvec3(100, 0, 0) + velocity * 2.0)), 1e-9);
  // Seen: the time constant behind.
  const glm::dvec3 lag = motion.goal().eye - motion.seen().eye;
  EXPECT_LT(glm::length(lag - velocity * CameraMotion::kFollowSeconds), 1e-9);
  EXPECT_FALSE(motion.resting());
}

// A goal that differs in everything, reached in one step, in many equal ones and in random ones.
CameraMotion after(const std::vector<double>& steps, Anchor anchor) {
  CameraMotion motion(poseAt({1, 2, 3}));
  CameraPose goal = orbited(poseAt({5, -2, 1}, 4), 1.2, -0.4);
  motion.setGoal(goal);
  for (const double seconds : steps) motion.advance(seconds, {0.3, 2, -1}, anchor);
  return motion;
}

TEST(Motion, howTimeIsCutIntoFramesDoesNotChangeThePath) {
  const unsigned seed = 11;
  SCOPED_TRACE(fmt::format("seed {}", seed));
  std::mt19937 random(seed);
  for (const Anchor anchor : {Anchor::eye, Anchor::pivot}) {
    const CameraMotion once = after({0.25}, anchor);
    std::vector<std::vector<double>> cuts = {std::vector<double>(250, 0.001), {0.2, 0.05}, {0, 0.25, 0}};
    std::vector<double> uneven;
    double left = 0.25;
    while (left > 1e-4) {
      uneven.push_back(left * std::uniform_real_distribution<double>(0, 1)(random));
      left -= uneven.back();
    }
    uneven.push_back(left);
    cuts.push_back(uneven);
    for (const auto& cut : cuts) {
      const CameraMotion many = after(cut, anchor);
      EXPECT_LT(glm::length(many.seen().eye - once.seen().eye), 1e-9);
      EXPECT_LT(glm::length(many.goal().eye - once.goal().eye), 1e-9);
      EXPECT_NEAR(many.seen().yawRad, once.seen().yawRad, 1e-9);
      EXPECT_NEAR(many.seen().pitchRad, once.seen().pitchRad, 1e-9);
      EXPECT_NEAR(many.seen().distance, once.seen().distance, 1e-9);
    }
  }
}

TEST(Motion, anOrbitKeepsThePivotOnItsWay) {
  const CameraPose start = poseAt({10, 0, 0});
  CameraMotion motion(start);
  motion.setGoal(orbited(start, 2, 0.7));
  for (int i = 0; i < 20; ++i) {
    motion.advance(0.01, glm::dvec3(0), Anchor::pivot);
    EXPECT_LT(glm::length(pivotOf(motion.seen()) - pivotOf(start)), 1e-9);
    EXPECT_NEAR(motion.seen().distance, 10, 1e-9);
  }
  EXPECT_GT(motion.seen().yawRad, 1.5);
  EXPECT_LT(motion.seen().yawRad, 2);
}

TEST(Motion, itComesToRestWhereTheGoalIsAtAnyScaleAndFarFromTheOrigin) {
  for (const double scale : {1e-9, 1e-3, 1.0, 1e9})
    for (const double offset : {0.0, 1e3, 1e7})
      for (const Anchor anchor : {Anchor::eye, Anchor::pivot}) {
        CameraMotion motion(poseAt(glm::dvec3(offset, -offset, offset / 3) * scale, scale));
        EXPECT_TRUE(motion.resting());
        motion.setGoal(dollied(orbited(motion.goal(), 1, 0.3), glm::dvec3(offset) * scale, 0.5));
        EXPECT_FALSE(motion.resting());
        int frames = 0;
        for (; !motion.resting() && frames < 1000; ++frames) motion.advance(0.016, glm::dvec3(0), anchor);
        EXPECT_LT(frames, 200) << scale << " " << offset;
        EXPECT_EQ(motion.seen().eye, motion.goal().eye);
        EXPECT_EQ(motion.seen().yawRad, motion.goal().yawRad);
      }
}

TEST(Motion, anotherPivotIsNotSeen) {
  CameraMotion motion(poseAt({3, 4, 5}));
  motion.setDistance(2);
  EXPECT_EQ(motion.seen().eye, glm::dvec3(3, 4, 5));
  EXPECT_TRUE(motion.resting());
}

}  // namespace
}  // namespace farcell
