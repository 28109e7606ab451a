#include "tools/evaluate/path/generated_path.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/support/evaluate_models.h"

namespace farcell {
namespace {

class GeneratedPath : public ::testing::Test {
 protected:
  PackFile packOf(const testing::TestModel& model, bool oneLeaf) {
    testing::writeTestPack(model, directory_.path() / "m.far", 1, oneLeaf);
    return PackFile::open(directory_.path() / "m.far").value();
  }
  testing::TemporaryDirectory directory_;
};

double angleDeg(glm::dvec3 a, glm::dvec3 b) {
  return std::acos(std::clamp(glm::dot(glm::normalize(a), glm::normalize(b)), -1.0, 1.0)) * 180 / std::numbers::pi;
}

glm::dvec3 horizontal(glm::dvec3 v) { return {v.x, v.y, 0}; }

TEST_F(GeneratedPath, OrbitGoesAroundByHalfADegreeAFrame) {
  const glm::dvec3 centre(100, 200, 300);
  const PackFile pack = packOf(testing::sphereModel(centre, 10, 2), false);
  const double radius = 10 * std::sqrt(3.0);  // of the sphere around the bounding box
  const auto frames = generatedPath("orbit", pack, 20, 7).value();
  ASSERT_EQ(frames.size(), 20u);
  for (size_t i = 0; i < frames.size(); ++i) {
    const glm::dvec3 arm = frames[i].position - centre;
    EXPECT_NEAR(glm::length(arm), 3 * radius, 0.01);
    EXPECT_NEAR(arm.z, frames[0].position.z - centre.z, 0.01);
    const double elevation = 90 - angleDeg(arm, {0, 0, 1});
    EXPECT_GT(elevation, 9);
    EXPECT_LT(elevation, 51);
    if (i > 0) {
      EXPECT_NEAR(angleDeg(horizontal(arm), horizontal(frames[i - 1].position - centre)), kOrbitStepDeg, 1e-3);
    }
  }
  EXPECT_EQ(generatedPath("orbit", pack, 20, 7).value()[3].position, frames[3].position);
  EXPECT_NE(generatedPath("orbit", pack, 20, 8).value()[3].position, frames[3].position);
}

TEST_F(GeneratedPath, FlybyComesAsNearAsItSays) {
  const glm::dvec3 centre(100, 200, 300);
  const PackFile pack = packOf(testing::sphereModel(centre, 10, 2), false);
  const double radius = 10 * std::sqrt(3.0);
  const auto frames = generatedPath("flyby", pack, 31, 7).value();
  double nearest = 1e9;
  for (const Camera& frame : frames) nearest = std::min(nearest, glm::length(frame.position - centre));
  EXPECT_NEAR(nearest, 1.5 * radius, 0.01) << "a quarter of a diameter from the surface";
  EXPECT_NEAR(glm::length(frames.back().position - frames.front().position), 6 * radius, 0.01);
}

// A plate of small squares at a height, or a wall where two corners of a square share x or y.
void addQuads(testing::TestModel& model, glm::dvec3 corner, glm::dvec3 u, glm::dvec3 v) {
  const int countU = static_cast<int>(glm::length(u)), countV = static_cast<int>(glm::length(v));
  for (int i = 0; i < countU; ++i)
    for (int j = 0; j < countV; ++j) {
      const glm::dvec3 p = corner + u * (double(i) / countU) + v * (double(j) / countV);
      const glm::dvec3 du = u / double(countU), dv = v / double(countV);
      InputTriangle triangle{};
      triangle.positions = {p, p + du, p + dv};
      model.triangles.push_back(triangle);
      triangle.positions = {p + du, p + du + dv, p + dv};
      model.triangles.push_back(triangle);
    }
}

// Two blocks with an alley between them, y in (46, 54): the only way at eye height with anything beside it.
TEST_F(GeneratedPath, StreetKeepsBetweenTheBlocks) {
  testing::TestModel model;
  model.grid = gridAround({0, 0, 0}, {100, 100, 20});
  for (const double y : {0.0, 54.0}) {
    addQuads(model, {0, y, 20}, {100, 0, 0}, {0, 46, 0});
    for (const double side : {y, y + 46}) addQuads(model, {0, side, 0}, {100, 0, 0}, {0, 0, 20});
    for (const double side : {0.0, 100.0}) addQuads(model, {side, y, 0}, {0, 46, 0}, {0, 0, 20});
  }
  const PackFile pack = packOf(model, true);
  for (const uint32_t seed : {1u, 2u, 3u}) {
    const auto frames = generatedPath("street", pack, 100, seed);
    ASSERT_TRUE(frames) << frames.error().message;
    ASSERT_EQ(frames->size(), 100u);
    for (const Camera& frame : *frames) {
      EXPECT_GT(frame.position.y, 45.9) << "seed " << seed;
      EXPECT_LT(frame.position.y, 54.1) << "seed " << seed;
      EXPECT_GT(frame.position.z, 0);
      EXPECT_LT(frame.position.z, 1) << "near the ground";
    }
    const double diagonal = 100 * std::sqrt(2.0);
    EXPECT_NEAR(glm::length((*frames)[1].position - (*frames)[0].position), diagonal / 4000, 1e-6);
  }
}

}  // namespace
}  // namespace farcell
