#include "preprocess/choose/region.h"

#include <gtest/gtest.h>

#include <random>

#include "cache/base/file.h"

namespace farcell {
namespace {

Result<Region> parsed(const std::string& text, double metresPerUnit = 1) {
  return regionFromJson(text, "walk.json", metresPerUnit);
}

bool inside(const WorldBox& box, glm::dvec3 point) {
  for (int axis = 0; axis < 3; ++axis)
    if (point[axis] < box.min[axis] || point[axis] > box.max[axis]) return false;
  return true;
}

bool inside(const Region& region, glm::dvec3 point) {
  for (const WorldBox& box : region.boxes)
    if (inside(box, point)) return true;
  return false;
}

TEST(Region, HasTwoNames) {
  EXPECT_EQ(readRegion("everywhere", 1)->kind, Region::Kind::everywhere);
  EXPECT_EQ(readRegion("above-ground", 1)->kind, Region::Kind::aboveGround);
  const auto missing = readRegion("/nowhere/box.json", 1);
  ASSERT_FALSE(missing);
  EXPECT_EQ(missing.error().kind, ErrorKind::notFound);
}

TEST(Region, ReadsBoxes) {
  const auto one = parsed(R"({"min": [1, 2, 3], "max": [4, 5, 3]})");
  ASSERT_TRUE(one) << one.error().message;
  ASSERT_EQ(one->boxes.size(), 1u);
  EXPECT_EQ(one->boxes[0].min, glm::dvec3(1, 2, 3));
  EXPECT_EQ(one->boxes[0].max, glm::dvec3(4, 5, 3));
  const auto two = parsed(R"({"boxes": [{"min": [0,0,0], "max": [1,1,1]}, {"min": [2,0,0], "max": [3,1,1]}]})");
  ASSERT_TRUE(two) << two.error().message;
  EXPECT_EQ(two->boxes.size(), 2u);
}

TEST(Region, ReadsCameraFilesWithWhatElseTheyHold) {
  const auto region = parsed(
      R"({"cameras": [{"name": "a", "position": [1, 2, 3], "target": [0, 0, 0], "up": [0, 0, 1], "fovYDeg": 40}],
          "radius": 5})",
      10);
  ASSERT_TRUE(region) << region.error().message;
  ASSERT_EQ(region->boxes.size(), 1u);
  EXPECT_EQ(region->boxes[0].min, glm::dvec3(0.5, 1.5, 2.5));
  EXPECT_EQ(region->boxes[0].max, glm::dvec3(1.5, 2.5, 3.5));
}

TEST(Region, HoldsAllThatIsNearAPath) {
  const auto region = parsed(R"({"path": [[0, 0, 0], [10, 20, 5], [-7, 3, 5]], "radius": 0.5})");
  ASSERT_TRUE(region) << region.error().message;
  const std::vector<glm::dvec3> points = {{0, 0, 0}, {10, 20, 5}, {-7, 3, 5}};
  std::mt19937 random(1);
  std::uniform_real_distribution<double> unit(0, 1);
  for (int i = 0; i < 2000; ++i) {
    const size_t segment = i % 2;
    const double along = unit(random);
    const glm::dvec3 offset(unit(random) - 0.5, unit(random) - 0.5, unit(random) - 0.5);
    const glm::dvec3 point = points[segment] * (1 - along) + points[segment + 1] * along + offset / std::sqrt(3.0);
    EXPECT_TRUE(inside(*region, point)) << point.x << " " << point.y << " " << point.z;
  }
  EXPECT_FALSE(inside(*region, {10, 0, 5})) << "boxes keep near a diagonal";
}

TEST(Region, RefusesWhatIsNoRegion) {
  for (const char* text : {"",
                           "{",
                           "[]",
                           "{}",
                           "7",
                           R"({"min": [0,0,0]})",
                           R"({"min": [0,0,0], "max": [1,1]})",
                           R"({"min": [0,0,2], "max": [1,1,1]})",
                           R"({"min": [0,0,0], "max": [1,1,1], "radius": 1})",
                           R"({"min": ["0",0,0], "max": [1,1,1]})",
                           R"({"min": [0,0,0], "max": [1,1,1e999]})",
                           R"({"min": [0,0,0], "min": [0,0,0], "max": [1,1,1]})",
                           R"({"boxes": []})",
                           R"({"boxes": [{}]})",
                           R"({"path": []})",
                           R"({"path": [[0,0,0]], "radius": -1})",
                           R"({"path": [[0,0,0]], "radius": "1"})",
                           R"({"path": [[1e308,0,0]], "radius": 1.7e308})",
                           R"({"path": [[0,0]]})",
                           R"({"cameras": [{}]})",
                           R"({"cameras": [7]})",
                           R"({"path": [[0,0,0]], "cameras": []})",
                           "[[[[[[[[[[[[]]]]]]]]]]]]"}) {
    const auto region = parsed(text);
    ASSERT_FALSE(region) << text;
    EXPECT_NE(region.error().message.find("walk.json"), std::string::npos) << region.error().message;
  }
}

TEST(Region, RefusesEveryTruncation) {
  const std::string text = R"({"path": [[0, 0, 0], [1, 2, 3]], "radius": 0.5})";
  for (size_t length = 0; length < text.size(); ++length) EXPECT_FALSE(parsed(text.substr(0, length))) << length;
}

TEST(Region, BoundsWhatItReads) {
  std::string many = R"({"path": [[0,0,0])";
  for (int i = 0; i < 100'000; ++i) many += ",[0,0,0]";
  const auto region = parsed(many + "]}");
  ASSERT_FALSE(region);
  EXPECT_EQ(region.error().kind, ErrorKind::exhausted);
}

}  // namespace
}  // namespace farcell
