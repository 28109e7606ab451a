#include "cache/schema/grid.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <random>
#include <vector>

namespace farcell {
namespace {

struct Box {
  glm::dvec3 min, max;
};

double magnitude(const Box& box) {
  double result = 0;
  for (int axis = 0; axis < 3; ++axis) result = std::max({result, std::abs(box.min[axis]), std::abs(box.max[axis])});
  return result;
}

// Models of every size and place, each given by its bounding box: cubes, plates, needles, points.
std::vector<Box> models() {
  std::vector<Box> result;
  const std::vector<glm::dvec3> shapes = {{1, 1, 1}, {1, 0.3, 0.01}, {1, 1, 0}, {0, 0, 1}, {0, 0, 0}};
  for (const double scale : {1e-30, 1e-12, 1e-3, 1.0, 1e4, 1e9, 1e30})
    for (const double offset : {0.0, 1.0, -5e6, 1e9})
      for (const glm::dvec3& shape : shapes) {
        const glm::dvec3 origin(offset, -offset, 0.25 * offset);
        result.push_back({origin - shape * (0.5 * scale), origin + shape * (0.5 * scale)});
      }
  return result;
}

glm::dvec3 lerp(const Box& box, glm::dvec3 t) { return box.min + (box.max - box.min) * t; }

TEST(Grid, HoldsTheWholeModelStrictlyInsideACubeThatCanBeCut) {
  for (const Box& box : models()) {
    const Grid grid = gridAround(box.min, box.max);
    ASSERT_TRUE(std::isfinite(grid.side) && grid.side > 0) << magnitude(box);
    ASSERT_GT(grid.step(), 0);
    for (int axis = 0; axis < 3; ++axis) {
      ASSERT_LT(grid.origin[axis], box.min[axis]) << magnitude(box);
      ASSERT_GT(grid.origin[axis] + grid.side, box.max[axis]) << magnitude(box);
    }
    const glm::dvec3 extent = box.max - box.min;
    const double longest = std::max({extent.x, extent.y, extent.z});
    // Not much larger than needed, wherever the coordinates can tell the model's size at all.
    if (longest > 1e-11 * magnitude(box)) {
      EXPECT_LE(grid.side, 1.001 * longest);
    }
  }
}

TEST(Grid, APointOfTheModelComesBackWithinHalfAStep) {
  const unsigned seed = 12;
  SCOPED_TRACE(seed);
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> unit(0, 1);
  for (const Box& box : models()) {
    const Grid grid = gridAround(box.min, box.max);
    // The step is exact; the world's own precision is what else may be lost.
    const double tolerance = 0.5 * grid.step() * (1 + 1e-9) + 4 * magnitude(box) * 0x1p-52;
    for (int i = 0; i < 50; ++i) {
      const glm::dvec3 point = lerp(box, {unit(random), unit(random), unit(random)});
      const glm::dvec3 back = grid.worldFromGrid(grid.gridFromWorld(point));
      for (int axis = 0; axis < 3; ++axis) ASSERT_NEAR(back[axis], point[axis], tolerance);
    }
  }
}

TEST(Grid, AGridPointComesBackExactlyWhereDoublesCanTellStepsApart) {
  std::mt19937 random(3);
  int tried = 0;
  for (const Box& box : models()) {
    const Grid grid = gridAround(box.min, box.max);
    if (grid.step() < 16 * magnitude(box) * 0x1p-52) continue;
    ++tried;
    const int32_t top = 1 << grid.bits;
    std::uniform_int_distribution<int32_t> coordinate(0, top);
    for (int i = 0; i < 50; ++i) {
      const GridPoint point(coordinate(random), coordinate(random), coordinate(random));
      ASSERT_EQ(grid.gridFromWorld(grid.worldFromGrid(point)), point);
    }
    ASSERT_EQ(grid.gridFromWorld(grid.worldFromGrid(GridPoint(0))), GridPoint(0));
    ASSERT_EQ(grid.gridFromWorld(grid.worldFromGrid(GridPoint(top))), GridPoint(top));
  }
  EXPECT_GT(tried, 50);
}

TEST(Grid, PointsOutsideAreClampedToTheCube) {
  const Grid grid = gridAround({0, 0, 0}, {1, 1, 1});
  const int32_t top = 1 << grid.bits;
  EXPECT_EQ(grid.gridFromWorld({-1e300, 5, -1}), GridPoint(0, top, 0));
  EXPECT_EQ(grid.gridFromWorld({INFINITY, -INFINITY, 1e18}), GridPoint(top, 0, top));
}

TEST(Grid, ACellsChildrenFillItsBoxWithoutOverlap) {
  const Grid grid = gridAround({-5, 2, 1000}, {7, 9, 1003});
  std::mt19937 random(8);
  for (int i = 0; i < 200; ++i) {
    const uint32_t level = static_cast<uint32_t>(random() % kMaxLevel);
    const uint32_t mask = (1u << level) - 1;
    const CellKey key{level, static_cast<uint32_t>(random()) & mask, static_cast<uint32_t>(random()) & mask,
                      static_cast<uint32_t>(random()) & mask};
    const GridBox box = cellBox(grid, key);
    GridBox together;
    for (uint32_t octant = 0; octant < 8; ++octant) {
      const CellKey child = key.child(octant);
      EXPECT_EQ(child.parent(), key);
      EXPECT_EQ(child.octant(), octant);
      const GridBox part = cellBox(grid, child);
      for (int axis = 0; axis < 3; ++axis) {
        const int32_t middle = (box.min[axis] + box.max[axis]) / 2;
        ASSERT_EQ(part.min[axis], octant >> axis & 1 ? middle : box.min[axis]);
        ASSERT_EQ(part.max[axis], octant >> axis & 1 ? box.max[axis] : middle);
      }
      together.include(part);
    }
    ASSERT_EQ(together, box);
  }
}

TEST(Grid, BoxCentreAndHalfSideOfACellAgree) {
  for (const Box& model : models()) {
    const Grid grid = gridAround(model.min, model.max);
    for (const CellKey& key :
         {CellKey{}, CellKey{1, 1, 0, 1}, CellKey{7, 100, 3, 127}, CellKey{kMaxLevel, 32767, 0, 16384}}) {
      const GridBox box = cellBox(grid, key);
      const glm::dvec3 low = grid.worldFromGrid(box.min), high = grid.worldFromGrid(box.max);
      const glm::dvec3 centre = cellCentre(grid, key);
      const double half = cellHalfSide(grid, key);
      EXPECT_EQ(half * std::ldexp(2.0, static_cast<int>(key.level)), grid.side);
      const double tolerance = 4 * 0x1p-52 * (magnitude(model) + grid.side);
      for (int axis = 0; axis < 3; ++axis) {
        ASSERT_NEAR(centre[axis] - half, low[axis], tolerance);
        ASSERT_NEAR(centre[axis] + half, high[axis], tolerance);
      }
    }
  }
}

TEST(Grid, TheRootBoxIsTheWholeGrid) {
  const Grid grid = gridAround({0, 0, 0}, {1, 2, 3});
  EXPECT_EQ(cellBox(grid, CellKey{}), (GridBox{GridPoint(0), GridPoint(1 << grid.bits)}));
}

// Bit by bit, the definition of the code.
uint64_t slowMorton(const CellKey& key) {
  uint64_t code = 0;
  for (int bit = 0; bit < 21; ++bit) {
    code |= uint64_t{key.x >> bit & 1} << (3 * bit);
    code |= uint64_t{key.y >> bit & 1} << (3 * bit + 1);
    code |= uint64_t{key.z >> bit & 1} << (3 * bit + 2);
  }
  return code;
}

TEST(Grid, MortonCodesInterleaveTheBitsAndChildrenFollowTheirParentsOrder) {
  std::mt19937 random(21);
  for (int i = 0; i < 2000; ++i) {
    const uint32_t mask = (1u << kMaxLevel) - 1;
    const CellKey key{kMaxLevel, static_cast<uint32_t>(random()) & mask, static_cast<uint32_t>(random()) & mask,
                      static_cast<uint32_t>(random()) & mask};
    ASSERT_EQ(mortonCode(key), slowMorton(key));
    for (uint32_t octant = 0; octant < 8; ++octant)
      ASSERT_EQ(mortonCode(key.child(octant)), mortonCode(key) * 8 + octant);
  }
}

TEST(Grid, ABoxStartsEmptyAndGrowsToWhatItIncludes) {
  GridBox box;
  EXPECT_TRUE(box.empty());
  box.include(GridBox{});
  EXPECT_TRUE(box.empty());
  box.include(GridPoint(3, -4, 5));
  EXPECT_FALSE(box.empty());
  EXPECT_EQ(box, (GridBox{GridPoint(3, -4, 5), GridPoint(3, -4, 5)}));
  box.include(GridBox{GridPoint(-1, 0, 0), GridPoint(0, 9, 0)});
  EXPECT_EQ(box, (GridBox{GridPoint(-1, -4, 0), GridPoint(3, 9, 5)}));
}

}  // namespace
}  // namespace farcell
