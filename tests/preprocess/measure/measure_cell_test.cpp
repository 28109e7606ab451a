#include "preprocess/measure/measure_cell.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "preprocess/encode/view_image.h"
#include "tests/preprocess/bake/bake_scenes.h"

namespace farcell {
namespace {

constexpr int kImageSize = 64;

const Viewpoints& viewpoints() {
  static const Viewpoints set = *Viewpoints::create(42);
  return set;
}

ViewOf viewsOf(const CellSoup& soup) {
  return [&soup](int view) -> Result<ViewImage> {
    const auto baked = test::bake(soup, viewFrame(viewpoints().directions()[static_cast<size_t>(view)]),
                                  {kImageSize, 16, {0, 0, 1}, false});
    return quantisedView(baked.view, static_cast<uint32_t>(view), kImageSize);
  };
}

CellErrors measured(const CellSoup& alone, const CellSoup& grown, const CellSoup* mesh, LocalBox content) {
  const MeasureSettings settings{viewpoints(), kImageSize, 16, {0, 0, 1}, Lighting::baked, 0};
  const auto errors = measureCell({content, alone, grown, mesh, nullptr, nullptr}, viewsOf(grown), settings);
  if (!errors) throw std::runtime_error(errors.error().message);
  return *errors;
}

double meanError(const ErrorSum& sum) { return sum.error / sum.covered; }
double ratio(const CellErrors& errors, ErrorWay way, size_t scale) {
  return meanError(errors.ways[static_cast<size_t>(way)][scale]) / meanError(errors.single[scale]);
}

constexpr LocalBox kSphereBox = {glm::vec3(-0.8f), glm::vec3(0.8f)};

TEST(MeasuredDirections, areAsFarFromTheNearestViewAsDirectionsAre) {
  for (const int count : {12, 42, 162, 642, 20, 80}) {
    const Viewpoints set = *Viewpoints::create(count);
    const auto angle = [&](glm::dvec3 direction) {
      return std::acos(glm::dot(set.directions()[static_cast<size_t>(set.nearest(direction))], direction));
    };
    double mean = 0;
    constexpr int kSpiral = 500;
    for (int i = 0; i < kSpiral; ++i) {
      const double height = 2 * (i + 0.5) / kSpiral - 1, around = std::sqrt(1 - height * height);
      mean += angle({around * std::cos(2.399963 * i), around * std::sin(2.399963 * i), height}) / kSpiral;
    }
    for (const glm::dvec3 direction : measuredDirections())
      EXPECT_NEAR(angle(glm::normalize(direction)) / mean, 1, 0.15) << count;
  }
}

TEST(MeasureCell, fourSamplesOfTheSameMeshHaveAboutHalfOfTheErrorOfOne) {
  CellSoup sphere = test::sphereSoup(4, 0.8f);
  for (size_t t = 0; t < sphere.size(); ++t)
    for (size_t k = 0; k < 3; ++k) sphere.colours[k][t] = t % 2 != 0 ? 0x2040ff : 0xe0e040;
  const CellErrors errors = measured(sphere, sphere, &sphere, kSphereBox);
  for (size_t scale = 0; scale < kErrorScales; ++scale) {
    EXPECT_GT(ratio(errors, ErrorWay::mesh, scale), 0.2);
    EXPECT_LT(ratio(errors, ErrorWay::mesh, scale), 0.65);
  }
}

TEST(MeasureCell, impostorsAreWorseTheLargerTheirTexels) {
  CellSoup sphere = test::sphereSoup(4, 0.8f);
  for (size_t t = 0; t < sphere.size(); ++t)
    for (size_t k = 0; k < 3; ++k) sphere.colours[k][t] = t % 2 != 0 ? 0x2040ff : 0xe0e040;
  const CellErrors errors = measured(sphere, sphere, nullptr, kSphereBox);
  for (const ErrorWay way : {ErrorWay::depthCorrected, ErrorWay::blended}) {
    for (size_t scale = 1; scale < kErrorScales; ++scale)
      EXPECT_GT(ratio(errors, way, scale), ratio(errors, way, scale - 1));
    EXPECT_LT(ratio(errors, way, 0), 0.5);
  }
  EXPECT_EQ(errors.ways[static_cast<size_t>(ErrorWay::mesh)][0].covered, 0) << "there is none";
}

TEST(MeasureCell, aCoarserMeshHasMoreError) {
  const CellSoup fine = test::sphereSoup(4, 0.8f), coarse = test::sphereSoup(1, 0.8f);
  const CellErrors same = measured(fine, fine, &fine, kSphereBox), other = measured(fine, fine, &coarse, kSphereBox);
  for (size_t scale = 0; scale < kErrorScales; ++scale) {
    EXPECT_GT(ratio(other, ErrorWay::mesh, scale), 2 * ratio(same, ErrorWay::mesh, scale));
    EXPECT_EQ(meanError(other.single[scale]), meanError(same.single[scale]));
  }
}

// A plate that goes on beyond the cube has no edge there.
TEST(MeasureCell, whatGoesOnInTheNeighbourHasNoEdge) {
  CellSoup alone, grown;
  test::addRectangle(alone, {-1, -1, 0}, {2, 0, 0}, {0, 2, 0}, 0x808080);
  test::addRectangle(grown, {-1.04f, -1.04f, 0}, {2.08f, 0, 0}, {0, 2.08f, 0}, 0x808080);
  const LocalBox content{glm::vec3(-1, -1, 0), glm::vec3(1, 1, 0)};
  const CellErrors open = measured(alone, alone, &alone, content), continued = measured(alone, grown, &alone, content);
  EXPECT_GT(meanError(open.single[1]), 1);
  EXPECT_EQ(continued.single[1].error, 0);
  EXPECT_EQ(continued.ways[static_cast<size_t>(ErrorWay::mesh)][1].error, 0);
  EXPECT_LT(meanError(continued.ways[static_cast<size_t>(ErrorWay::depthCorrected)][1]), 1);
  EXPECT_GT(continued.single[1].covered, 0.7 * open.single[1].covered);
}

}  // namespace
}  // namespace farcell
