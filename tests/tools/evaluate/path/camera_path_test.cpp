#include "tools/evaluate/path/camera_path.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

namespace farcell {
namespace {

std::string keyframe(const std::string& name, const std::string& more = "", const std::string& position = "[0,0,5]") {
  return R"({"name":")" + name + R"(","position":)" + position + R"(,"target":[0,0,0],"up":[0,1,0],"fovYDeg":40)" +
         more + "}";
}

std::string pathOf(const std::string& keyframes) { return "{\"cameras\":[" + keyframes + "]}"; }

std::string errorOf(const std::string& json) {
  const auto keyframes = parseKeyframes(json, "p.json");
  if (keyframes) return "";
  EXPECT_EQ(keyframes.error().kind, ErrorKind::invalidArgument);
  return keyframes.error().message;
}

TEST(Keyframes, TakeTheirTimesOrASecondEach) {
  const auto timed =
      parseKeyframes(pathOf(keyframe("a", R"(,"time":-2)") + "," + keyframe("b", R"(,"time":7.5)")), "p");
  ASSERT_TRUE(timed) << timed.error().message;
  EXPECT_EQ((*timed)[0].seconds, -2);
  EXPECT_EQ((*timed)[1].seconds, 7.5);
  EXPECT_EQ((*timed)[1].camera.name, "b");
  const auto plain = parseKeyframes(pathOf(keyframe("a") + "," + keyframe("b") + "," + keyframe("c")), "p");
  ASSERT_TRUE(plain) << plain.error().message;
  EXPECT_EQ((*plain)[2].seconds, 2);
}

TEST(Keyframes, HostileFilesAreErrorsThatNameTheCamera) {
  EXPECT_NE(errorOf("").find("p.json"), std::string::npos);
  EXPECT_NE(errorOf("[[[[").find("p.json"), std::string::npos);
  EXPECT_NE(errorOf(std::string(1 << 16, '[')).find("p.json"), std::string::npos);
  EXPECT_NE(errorOf(pathOf(keyframe("a"))).find("two cameras"), std::string::npos);
  EXPECT_NE(errorOf(pathOf(keyframe("a", R"(,"time":0)") + "," + keyframe("b"))).find("'b': member 'time' is missing"),
            std::string::npos);
  for (const char* time : {"\"1\"", "null", "[1]", "{}", "true"})
    EXPECT_NE(errorOf(pathOf(keyframe("a", R"(,"time":0)") + "," + keyframe("b", std::string(",\"time\":") + time)))
                  .find("'b': time: expected a finite number"),
              std::string::npos)
        << time;
  for (const char* time : {"0", "-1"})
    EXPECT_NE(errorOf(pathOf(keyframe("a", R"(,"time":0)") + "," + keyframe("b", std::string(",\"time\":") + time)))
                  .find("'b': time: expected more than 0"),
              std::string::npos)
        << time;
  EXPECT_NE(errorOf(pathOf(keyframe("a") + "," + keyframe("b", "", "[0,0,1e999]"))), "");
  EXPECT_FALSE(readKeyframes("/absent/path.json"));
}

Keyframe at(double seconds, glm::dvec3 position, glm::dvec3 target, double fovYDeg = 40) {
  return {{"k", position, target, {0, 0, 1}, fovYDeg * std::numbers::pi / 180}, seconds};
}

TEST(PathFrames, PassTheKeyframesAtTheirTimes) {
  const std::vector<Keyframe> keyframes = {at(1, {0, 0, 0}, {1, 0, 0}, 20), at(2, {5, 1, 0}, {1, 3, 0}, 90),
                                           at(4, {-3, 7, 2}, {1, 0, 9}, 5), at(5, {0, 2, 8}, {1, 0, 0}, 120)};
  const auto frames = pathFrames(keyframes, 9);  // half a second each
  ASSERT_TRUE(frames) << frames.error().message;
  ASSERT_EQ(frames->size(), 9u);
  for (const Keyframe& keyframe : keyframes) {
    const Camera& frame = (*frames)[static_cast<size_t>((keyframe.seconds - 1) * 2)];
    EXPECT_LT(glm::length(frame.position - keyframe.camera.position), 1e-12);
    EXPECT_LT(glm::length(frame.target - keyframe.camera.target), 1e-12);
    EXPECT_NEAR(frame.fovYRad, keyframe.camera.fovYRad, 1e-12);
  }
  for (const Camera& frame : *frames) {
    EXPECT_GT(frame.fovYRad, 0);
    EXPECT_LT(frame.fovYRad, std::numbers::pi);
  }
}

// A thrown stone: what moves along a parabola does so between the keyframes too, however uneven their times.
TEST(PathFrames, FollowAParabolaExactly) {
  const auto stone = [](double t) { return glm::dvec3(3 * t, 2 - t, 10 + 4 * t - 0.5 * 9.81 * t * t); };
  std::vector<Keyframe> keyframes;
  for (const double t : {-1.0, -0.2, 0.5, 0.6, 2.0, 3.0}) keyframes.push_back(at(t, stone(t), {50, 50, 50}));
  const auto frames = pathFrames(keyframes, 81);
  ASSERT_TRUE(frames) << frames.error().message;
  for (size_t i = 0; i < frames->size(); ++i)
    EXPECT_LT(glm::length((*frames)[i].position - stone(-1 + 0.05 * static_cast<double>(i))), 1e-9) << i;
}

TEST(PathFrames, OfTwoKeyframesAreAStraightLineAtOneSpeed) {
  const std::vector<Keyframe> keyframes = {at(0, {0, 0, 0}, {9, 9, 9}), at(8, {4, 8, -4}, {9, 9, 9})};
  const auto frames = pathFrames(keyframes, 5);
  ASSERT_TRUE(frames);
  for (size_t i = 0; i < 5; ++i)
    EXPECT_LT(glm::length((*frames)[i].position - glm::dvec3(1, 2, -1) * static_cast<double>(i)), 1e-12);
}

TEST(PathFrames, WhereNothingCanBeSeenAreErrors) {
  // Eye and target change places: they meet half way.
  const std::vector<Keyframe> crossing = {at(0, {0, 0, 0}, {2, 0, 0}), at(1, {2, 0, 0}, {0, 0, 0})};
  const auto frames = pathFrames(crossing, 3);
  ASSERT_FALSE(frames);
  EXPECT_NE(frames.error().message.find("frame 1: the target meets"), std::string::npos) << frames.error().message;
  const std::vector<Keyframe> huge = {at(0, {1e308, 0, 0}, {2, 0, 0}), at(1, {-1e308, 0, 0}, {0, 0, 0})};
  const auto infinite = pathFrames(huge, 3);
  ASSERT_FALSE(infinite);
  EXPECT_NE(infinite.error().message.find("not finite"), std::string::npos);
}

}  // namespace
}  // namespace farcell
