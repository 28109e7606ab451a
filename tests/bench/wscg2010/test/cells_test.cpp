#include "tests/bench/wscg2010/scene/cells.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/bench/wscg2010/test/samples.h"

namespace farcell::wscg {
namespace {

double areaOf(const std::vector<Triangle>& triangles) {
  double area = 0;
  for (const Triangle& t : triangles)
    area += 0.5 * glm::length(glm::cross(glm::dvec3(t.corners[1]) - glm::dvec3(t.corners[0]),
                                         glm::dvec3(t.corners[2]) - glm::dvec3(t.corners[0])));
  return area;
}

bool inCube(const CellKey& key, glm::dvec3 p) {
  const glm::dvec3 d = glm::abs(p - cellCentre(key));
  return std::max({d.x, d.y, d.z}) <= cellHalfSide(static_cast<int>(key.level));
}

// Points spread over a triangle.
std::vector<glm::dvec3> pointsOf(const Triangle& t, int count) {
  std::vector<glm::dvec3> points;
  for (int i = 0; i <= count; ++i)
    for (int j = 0; j <= count - i; ++j)
      points.push_back((glm::dvec3(t.corners[0]) * double(i) + glm::dvec3(t.corners[1]) * double(j) +
                        glm::dvec3(t.corners[2]) * double(count - i - j)) /
                       double(count));
  return points;
}

TEST(Cells, ACutModelHasTheWholeModelsAreaAtEveryDepth) {
  const uint32_t seed = 5;
  SCOPED_TRACE(seed);
  const Scene scene = sceneOf("soup", test::randomTriangles(seed, 400), UpAxis::z);
  const double whole = areaOf(scene.triangles);
  for (const int depth : {0, 1, 2, 3}) {
    const CellIndex index(scene, depth);
    double sum = 0;
    for (const CellKey& key : index.occupied()) sum += areaOf(index.cut(key));
    EXPECT_NEAR(sum, whole, 1e-4 * whole) << "depth " << depth;
  }
}

TEST(Cells, ACellIsOccupiedWhereAPointOfTheModelLies) {
  const Scene scene = sceneOf("sphere", test::bumpySphere(3, 0.2f), UpAxis::z);
  const CellIndex index(scene, 3);
  EXPECT_LT(index.occupied().size(), 400u);  // of 512: a surface leaves cells empty
  for (const Triangle& triangle : scene.triangles)
    for (const glm::dvec3& point : pointsOf(triangle, 4))
      EXPECT_TRUE(std::any_of(index.occupied().begin(), index.occupied().end(),
                              [&](const CellKey& key) { return inCube(key, point); }));
}

TEST(Cells, ContentGrownToTheSphereHoldsTheTrianglesThatMeetItAndNoOthers) {
  const uint32_t seed = 6;
  SCOPED_TRACE(seed);
  const Scene scene = sceneOf("soup", test::randomTriangles(seed, 300), UpAxis::z);
  const CellIndex index(scene, 2);
  for (const CellKey& key : index.occupied()) {
    const double radius = imageRadius(2, Content::sphere);
    size_t surely = 0, maybe = 0;
    for (const Triangle& triangle : scene.triangles) {
      double nearest = INFINITY;
      for (const glm::dvec3& point : pointsOf(triangle, 24))
        nearest = std::min(nearest, glm::length(point - cellCentre(key)));
      surely += nearest <= radius;
      maybe += nearest <= radius * 1.1;
    }
    const CellContent content = index.content(key, Content::sphere);
    EXPECT_GE(content.triangles.size(), surely);
    EXPECT_LE(content.triangles.size(), maybe);
    EXPECT_EQ(content.soup.size(), content.insideCount);
  }
}

TEST(Cells, EveryImageSphereHoldsItsContentUnlessTrianglesAreTakenWhole) {
  const Scene scene = sceneOf("sphere", test::bumpySphere(3, 0.2f), UpAxis::z);
  const CellIndex index(scene, 2);
  for (const CellKey& key : index.occupied())
    for (const Content content : {Content::cube, Content::grown}) {
      const CellContent cut = index.content(key, content);
      EXPECT_EQ(cut.insideCount, cut.triangles.size());
    }
}

}  // namespace
}  // namespace farcell::wscg
