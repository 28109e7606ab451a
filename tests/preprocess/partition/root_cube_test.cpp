#include "preprocess/partition/root_cube.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <map>
#include <random>

namespace farcell {
namespace {

// Points all over a sphere.
TriangleSample sphere(size_t count, glm::dvec3 centre, double radius) {
  std::mt19937_64 random(3);
  std::normal_distribution<double> normal;
  TriangleSample sample;
  for (size_t i = 0; i < count; ++i) {
    const glm::dvec3 direction(normal(random), normal(random), normal(random));
    const double length = std::sqrt(direction.x * direction.x + direction.y * direction.y + direction.z * direction.z);
    sample.add(centre + direction * (radius / length));
  }
  return sample;
}

BuildSettings leavesOf(int triangles) {
  BuildSettings settings;
  settings.leafTriangles = triangles;
  return settings;
}

// Cells of the octree, level by level from counts in a table: nothing in common with what is tested but the rule.
size_t cellsIn(const Grid& grid, const TriangleSample& sample, const BuildSettings& settings) {
  using Cell = std::array<int64_t, 3>;
  std::vector<glm::dvec3> open = sample.points();
  size_t cells = 0;
  for (int level = 0; !open.empty(); ++level) {
    const auto cellOf = [&](glm::dvec3 point) {
      const glm::dvec3 at = (point - grid.origin) / grid.side * std::ldexp(1.0, level);
      return Cell{static_cast<int64_t>(at.x), static_cast<int64_t>(at.y), static_cast<int64_t>(at.z)};
    };
    std::map<Cell, uint64_t> counts;
    for (const glm::dvec3& point : open) ++counts[cellOf(point)];
    cells += counts.size();
    std::erase_if(open, [&](glm::dvec3 point) {
      return counts[cellOf(point)] * sample.stride() <= static_cast<uint64_t>(settings.leafTriangles) ||
             level == settings.maxLevel;
    });
  }
  return cells;
}

Grid around(const TriangleSample& sample) {
  glm::dvec3 min = sample.points()[0], max = min;
  for (const glm::dvec3& point : sample.points()) {
    for (int axis = 0; axis < 3; ++axis) {
      min[axis] = std::min(min[axis], point[axis]);
      max[axis] = std::max(max[axis], point[axis]);
    }
  }
  return gridAround(min, max);
}

TEST(RootCube, NoOtherSizeHasFewerCells) {
  for (const int leafTriangles : {300, 700, 1500, 4000}) {
    const TriangleSample sample = sphere(40000, glm::dvec3(5, -3, 2), 10);
    const BuildSettings settings = leavesOf(leafTriangles);
    const Grid smallest = around(sample);
    const Grid chosen = rootCube(smallest, sample, settings);
    const size_t cells = cellsIn(chosen, sample, settings);
    for (int size = 0; size < 8; ++size) {
      Grid other = smallest;
      other.side *= std::exp2(size / 8.0);
      other.origin -= glm::dvec3((other.side - smallest.side) / 2);
      // The sizes differ from the roots in their fourth digit, and so may a cell or two.
      EXPECT_LE(cells, 1.01 * static_cast<double>(cellsIn(other, sample, settings))) << leafTriangles << ' ' << size;
    }
  }
}

TEST(RootCube, LeavesNearerToWhatTheyMayHold) {
  const TriangleSample sample = sphere(40000, glm::dvec3(0), 1);
  const BuildSettings settings = leavesOf(700);
  const Grid smallest = around(sample);
  EXPECT_LT(static_cast<double>(cellsIn(rootCube(smallest, sample, settings), sample, settings)),
            0.8 * static_cast<double>(cellsIn(smallest, sample, settings)));
}

TEST(RootCube, HoldsTheSmallestCubeAndHasItsCentre) {
  const TriangleSample sample = sphere(40000, glm::dvec3(1e6, 0, -1e6), 100);
  const Grid smallest = around(sample);
  const Grid chosen = rootCube(smallest, sample, leavesOf(700));
  EXPECT_GT(chosen.side, smallest.side);
  EXPECT_LT(chosen.side, 2 * smallest.side);
  for (int axis = 0; axis < 3; ++axis) {
    EXPECT_LE(chosen.origin[axis], smallest.origin[axis]);
    EXPECT_NEAR(chosen.origin[axis] + chosen.side / 2, smallest.origin[axis] + smallest.side / 2, 1e-9);
  }
}

TEST(RootCube, ScaleAndOffsetDoNotMatter) {
  const BuildSettings settings = leavesOf(700);
  const auto factor = [&](glm::dvec3 centre, double radius) {
    const TriangleSample sample = sphere(40000, centre, radius);
    const Grid smallest = around(sample);
    return rootCube(smallest, sample, settings).side / smallest.side;
  };
  const double expected = factor(glm::dvec3(0), 1);
  EXPECT_NEAR(factor(glm::dvec3(0), 1e-30), expected, 1e-6);
  EXPECT_NEAR(factor(glm::dvec3(0), 1e30), expected, 1e-6);
  EXPECT_NEAR(factor(glm::dvec3(5e5, 5e6, 100), 1000), expected, 1e-6);
}

TEST(RootCube, StaysSmallWhereNothingIsWon) {
  const TriangleSample sample = sphere(1000, glm::dvec3(0), 1);
  const Grid smallest = around(sample);
  EXPECT_EQ(rootCube(smallest, sample, leavesOf(1000)), smallest);
  BuildSettings fixed = leavesOf(10);
  fixed.fixedLevel = 3;
  EXPECT_EQ(rootCube(smallest, sample, fixed), smallest);
  TriangleSample point;
  for (int i = 0; i < 1000; ++i) point.add(glm::dvec3(1, 2, 3));
  EXPECT_EQ(rootCube(gridAround({1, 2, 3}, {1, 2, 3}), point, leavesOf(10)), gridAround({1, 2, 3}, {1, 2, 3}));
}

TEST(TriangleSample, KeepsEvenlyAsManyAsFit) {
  TriangleSample sample;
  const size_t count = 1000003;
  for (size_t i = 0; i < count; ++i) sample.add(glm::dvec3(static_cast<double>(i), 0, 0));
  EXPECT_LE(sample.points().size(), TriangleSample::kMostPoints);
  EXPECT_GE(sample.points().size(), TriangleSample::kMostPoints / 2 - 1);
  for (size_t i = 0; i < sample.points().size(); ++i)
    ASSERT_EQ(sample.points()[i].x, static_cast<double>(i * sample.stride()));
  EXPECT_GT((sample.points().size() + 1) * sample.stride(), count);
}

}  // namespace
}  // namespace farcell
