#include "preprocess/partition/grid_triangle.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>
#include <random>
#include <set>

namespace farcell {
namespace {

constexpr int32_t kSize = 1 << 20;

GridPoint randomPoint(std::mt19937& random, int32_t size = kSize) {
  std::uniform_int_distribution<int32_t> coordinate(0, size);
  return GridPoint(coordinate(random), coordinate(random), coordinate(random));
}

GridTriangle triangleOf(GridPoint a, GridPoint b, GridPoint c) { return {{a, b, c}, {0, 0, 0}, {0, 0, 0}}; }

double areaOf(const GridTriangle& triangle) {
  const glm::dvec3 a(triangle.corners[0]), b(triangle.corners[1]), c(triangle.corners[2]);
  return 0.5 * glm::length(glm::cross(b - a, c - a));
}

double areaOf(const std::vector<GridTriangle>& triangles) {
  double sum = 0;
  for (const GridTriangle& triangle : triangles) sum += areaOf(triangle);
  return sum;
}

struct Cut {
  std::vector<GridTriangle> low, high;
};

Cut cutTriangle(const GridTriangle& triangle, int axis, int32_t plane) {
  const CutPolygon parts = cutAt(polygonOf(triangle, {}), axis, plane);
  GridTriangles low, high;
  appendTriangles(parts.low, low);
  appendTriangles(parts.high, high);
  EXPECT_TRUE(low.textures.empty() && high.textures.empty());
  return {low.triangles, high.triangles};
}

TEST(CutTriangle, PartsLieOnTheirSideAndKeepTheArea) {
  const uint32_t seed = std::random_device{}();
  SCOPED_TRACE(seed);
  std::mt19937 random(seed);
  for (int round = 0; round < 2000; ++round) {
    const GridTriangle triangle = triangleOf(randomPoint(random), randomPoint(random), randomPoint(random));
    const int axis = round % 3;
    const int32_t plane = randomPoint(random).x;
    const auto [low, high] = cutTriangle(triangle, axis, plane);
    for (const GridTriangle& part : low)
      for (const GridPoint& corner : part.corners) EXPECT_LE(corner[axis], plane);
    for (const GridTriangle& part : high)
      for (const GridPoint& corner : part.corners) EXPECT_GE(corner[axis], plane);
    // Corners move by half a step at most, so the area by less than the perimeter.
    EXPECT_NEAR(areaOf(low) + areaOf(high), areaOf(triangle), 8.0 * kSize);
  }
}

TEST(CutTriangle, TrianglesThatShareAnEdgeGetTheSameNewCorner) {
  const uint32_t seed = std::random_device{}();
  SCOPED_TRACE(seed);
  std::mt19937 random(seed);
  for (int round = 0; round < 2000; ++round) {
    const GridPoint a = randomPoint(random), b = randomPoint(random);
    const int axis = round % 3;
    if (std::abs(a[axis] - b[axis]) < 2) continue;
    const int32_t plane = (a[axis] + b[axis]) / 2;
    // The corners on the plane that lie on the edge a-b, from triangles given in different orders and directions.
    std::set<std::array<int32_t, 3>> onEdge;
    for (const GridTriangle& triangle : {triangleOf(a, b, randomPoint(random)), triangleOf(b, randomPoint(random), a),
                                         triangleOf(randomPoint(random), b, a)}) {
      const auto [low, high] = cutTriangle(triangle, axis, plane);
      for (const auto& side : {low, high})
        for (const GridTriangle& part : side)
          for (const GridPoint& corner : part.corners) {
            const glm::dvec3 edge = glm::normalize(glm::dvec3(b - a));
            const glm::dvec3 offset(corner - a);
            const bool near = glm::length(offset - edge * glm::dot(offset, edge)) < 1.0;
            if (corner[axis] == plane && near && corner != a && corner != b)
              onEdge.insert({corner.x, corner.y, corner.z});
          }
    }
    EXPECT_EQ(onEdge.size(), 1u);
  }
}

TEST(CutTriangle, ATriangleInThePlaneBelongsToTheUpperSideOnly) {
  const GridTriangle flat = triangleOf(GridPoint(0, 0, 5), GridPoint(9, 0, 5), GridPoint(0, 9, 5));
  const auto [low, high] = cutTriangle(flat, 2, 5);
  EXPECT_EQ(low.size(), 0u);
  EXPECT_EQ(high.size(), 1u);
}

TEST(CutTriangle, ATriangleThatTouchesThePlaneIsNotCut) {
  const GridTriangle below = triangleOf(GridPoint(0, 0, 5), GridPoint(9, 0, 5), GridPoint(0, 9, 2));
  const auto [low, high] = cutTriangle(below, 2, 5);
  EXPECT_EQ(low.size(), 1u);
  EXPECT_EQ(high.size(), 0u);
}

TEST(CutTriangle, ColoursAreInterpolatedAlongTheEdge) {
  GridTriangle triangle = triangleOf(GridPoint(0, 0, 0), GridPoint(100, 0, 0), GridPoint(0, 100, 0));
  triangle.colours = {0x000000, 0x6400c8, 0x000000};
  const auto [low, high] = cutTriangle(triangle, 0, 50);
  ASSERT_EQ(high.size(), 1u);
  for (int k = 0; k < 3; ++k) EXPECT_EQ(high[0].colours[k], high[0].corners[k].x == 100 ? 0x6400c8u : 0x320064u);
}

// Texture coordinates that are an affine function of the position remain this function, up to the grid's rounding.
TEST(CutTriangle, TextureCoordinatesAreInterpolatedAlongTheEdge) {
  const uint32_t seed = std::random_device{}();
  SCOPED_TRACE(seed);
  std::mt19937 random(seed);
  const auto coordinatesAt = [](GridPoint p) { return glm::vec2(p.x - p.z, 2 * p.y) / float(kSize); };
  for (int round = 0; round < 500; ++round) {
    const GridTriangle triangle = triangleOf(randomPoint(random), randomPoint(random), randomPoint(random));
    TriangleTexture texture{3, {}};
    for (size_t k = 0; k < 3; ++k) texture.coordinates[k] = coordinatesAt(triangle.corners[k]);
    const CutPolygon parts = cutAt(polygonOf(triangle, texture), round % 3, randomPoint(random).x);
    GridTriangles all;
    appendTriangles(parts.low, all);
    appendTriangles(parts.high, all);
    ASSERT_EQ(all.textures.size(), all.size());
    for (size_t i = 0; i < all.size(); ++i) {
      EXPECT_EQ(all.textures[i].texture, 3u);
      for (size_t k = 0; k < 3; ++k)
        EXPECT_LT(glm::length(all.textures[i].coordinates[k] - coordinatesAt(all.triangles[i].corners[k])),
                  3.0f / float(kSize) + 1e-6f);
    }
  }
}

TEST(CutAt, APolygonCutManyTimesKeepsFewCorners) {
  const uint32_t seed = std::random_device{}();
  SCOPED_TRACE(seed);
  std::mt19937 random(seed);
  for (int round = 0; round < 500; ++round) {
    GridPolygon polygon = polygonOf(triangleOf(randomPoint(random), randomPoint(random), randomPoint(random)), {});
    GridPoint min(0), max(kSize);
    for (int level = 0; level < 12 && polygon.count > 0; ++level) {
      for (int axis = 0; axis < 3 && polygon.count > 0; ++axis) {
        const int32_t middle = (min[axis] + max[axis]) / 2;
        const CutPolygon parts = cutAt(polygon, axis, middle);
        const bool keepLow = parts.low.count > 0 && (parts.high.count == 0 || random() % 2 == 0);
        polygon = keepLow ? parts.low : parts.high;
        (keepLow ? max : min)[axis] = middle;
        EXPECT_LE(polygon.count, 9);  // a plane and the six faces of a cube
      }
    }
  }
}

TEST(IsDegenerate, SeesLinesAndPointsOnly) {
  EXPECT_TRUE(isDegenerate(triangleOf(GridPoint(1), GridPoint(1), GridPoint(5))));
  EXPECT_TRUE(isDegenerate(triangleOf(GridPoint(0), GridPoint(7), GridPoint(1 << 24))));
  EXPECT_FALSE(isDegenerate(triangleOf(GridPoint(0), GridPoint(1 << 24), GridPoint(1 << 23, 1 << 23, (1 << 23) + 1))));
}

TEST(PackNormal, KeepsDirectionsWithinAThousandthOfADegree) {
  const uint32_t seed = std::random_device{}();
  SCOPED_TRACE(seed);
  std::mt19937 random(seed);
  std::normal_distribution<float> gauss;
  for (int round = 0; round < 10000; ++round) {
    const glm::vec3 normal = glm::normalize(glm::vec3(gauss(random), gauss(random), gauss(random)));
    EXPECT_LT(glm::length(unpackNormal(packNormal(normal * 3.0f)) - normal), 1e-4f);
  }
}

}  // namespace
}  // namespace farcell
