#include "cache/schema/view_frame.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <random>
#include <vector>

#include "cache/schema/model.h"
#include "cache/schema/viewpoints.h"

namespace farcell {
namespace {

std::vector<glm::dvec3> directions() {
  std::vector<glm::dvec3> result;
  for (int x = -1; x <= 1; ++x)
    for (int y = -1; y <= 1; ++y)
      for (int z = -1; z <= 1; ++z)
        if (x != 0 || y != 0 || z != 0) result.push_back(glm::normalize(glm::dvec3(x, y, z)));
  for (const int count : {42, 320}) {
    const Viewpoints set = Viewpoints::create(count).value();
    result.insert(result.end(), set.directions().begin(), set.directions().end());
  }
  std::mt19937 random(17);
  std::normal_distribution<double> normal;
  for (int i = 0; i < 500; ++i) {
    const glm::dvec3 p(normal(random), normal(random), normal(random));
    result.push_back(glm::normalize(p));
  }
  return result;
}

TEST(ViewFrame, IsOrthonormalAndRightHandedForEveryDirectionAxesIncluded) {
  for (const glm::dvec3& direction : directions()) {
    const ViewFrame frame = viewFrame(direction);
    EXPECT_EQ(frame.toward, direction);
    ASSERT_NEAR(glm::length(frame.right), 1, 1e-14);
    ASSERT_NEAR(glm::length(frame.up), 1, 1e-14);
    ASSERT_NEAR(glm::dot(frame.right, frame.up), 0, 1e-14);
    ASSERT_NEAR(glm::dot(frame.right, frame.toward), 0, 1e-14);
    ASSERT_NEAR(glm::dot(frame.up, frame.toward), 0, 1e-14);
    ASSERT_LT(glm::length(glm::cross(frame.right, frame.up) - frame.toward), 1e-14);
  }
}

TEST(ViewFrame, OfTheAntipodeIsTheMirrorImageBitForBit) {
  for (const glm::dvec3& direction : directions()) {
    const ViewFrame frame = viewFrame(direction), mirrored = viewFrame(-direction);
    ASSERT_EQ(mirrored.up, frame.up);
    ASSERT_EQ(mirrored.right, -frame.right);
    ASSERT_EQ(mirrored.toward, -frame.toward);
  }
}

TEST(ViewFrame, AnImageHoldsTheWholeGrownCubeFromEveryDirection) {
  for (const glm::dvec3& direction : directions()) {
    const ViewFrame frame = viewFrame(direction);
    for (int corner = 0; corner < 8; ++corner) {
      const glm::dvec3 p = kCellGrowth * glm::dvec3(corner & 1 ? 1 : -1, corner & 2 ? 1 : -1, corner & 4 ? 1 : -1);
      ASSERT_LE(std::abs(glm::dot(p, frame.right)), kViewHalfExtent * (1 + 1e-14));
      ASSERT_LE(std::abs(glm::dot(p, frame.up)), kViewHalfExtent * (1 + 1e-14));
    }
  }
}

TEST(ViewFrame, TexelsCoverTheImage) {
  for (const int size : {16, 128, 1024}) EXPECT_DOUBLE_EQ(texelSize(size) * size, 2 * kViewHalfExtent);
}

TEST(Model, UpAndSunAreUnitVectorsAndTheSunStandsAboveTheHorizon) {
  for (const UpAxis up : {UpAxis::x, UpAxis::y, UpAxis::z}) {
    EXPECT_EQ(glm::length(upVector(up)), 1);
    EXPECT_EQ(upVector(up)[static_cast<int>(up)], 1);
    EXPECT_NEAR(glm::length(sunDirection(up, Sun{})), 1, 1e-6);
    EXPECT_GT(glm::dot(glm::dvec3(sunDirection(up, Sun{})), upVector(up)), 0.5);
  }
}

// To the bit: packs and pictures of no sun in particular stay what they were.
TEST(Model, TheSunUnlessToldOtherwiseIsTheDirectionSixFiveSeven) {
  const glm::vec3 expected(glm::normalize(glm::dvec3(0.6, 0.5, 0.7)));
  EXPECT_EQ(sunDirection(UpAxis::z, Sun{}), expected);
  EXPECT_EQ(sunText({}), "39.8056,41.8685");
}

TEST(Model, ASunIsTwoNumbersWithinATurnAndAQuarter) {
  for (const Sun& sun : {Sun{}, Sun{6.28, -1.57}, Sun{-6.28, 0}}) EXPECT_TRUE(isSun(sun));
  for (const Sun& sun : {Sun{6.29, 0}, Sun{0, 1.58}, Sun{NAN, 0}, Sun{0, NAN}, Sun{-INFINITY, 0}})
    EXPECT_FALSE(isSun(sun));
}

TEST(Model, TheSunOfTurnedAxesIsTheTurnedSun) {
  const glm::vec3 z = sunDirection(UpAxis::z, Sun{}), x = sunDirection(UpAxis::x, Sun{}), y = sunDirection(UpAxis::y, Sun{});
  for (int axis = 0; axis < 3; ++axis) {
    EXPECT_FLOAT_EQ(x[(axis + 1) % 3], z[axis]);
    EXPECT_FLOAT_EQ(y[(axis + 2) % 3], z[axis]);
  }
}

}  // namespace
}  // namespace farcell
