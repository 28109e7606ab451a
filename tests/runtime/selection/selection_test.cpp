#include "runtime/selection/selection.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <map>
#include <random>
#include <set>

#include "cache/schema/view_frame.h"

namespace farcell {
namespace {

constexpr int kWidth = 320, kHeight = 240;

// A random adaptive tree over a grid: leaves at several levels, some octants empty, some cells without views.
class RandomTree {
 public:
  RandomTree(unsigned seed, const Grid& grid) : random_(seed) {
    directory.model.grid = grid;
    directory.model.settings.imageSize = 64;
    directory.cells.push_back(cell({}, kNone));
    for (uint32_t i = 0; i < directory.cells.size(); ++i)
      if (directory.cells[i].key.level < 4 && (i < 3 || chance(0.4))) split(i);
    for (size_t i = directory.cells.size(); i-- > 0;) fill(directory.cells[i]);
  }

  Directory directory;

 private:
  bool chance(double p) { return std::uniform_real_distribution<double>(0, 1)(random_) < p; }

  CellRecord cell(const CellKey& key, uint32_t parent) {
    CellRecord record;
    record.key = key;
    record.parent = parent;
    if (chance(0.8)) record.firstViewPage = 0, record.viewPageCount = 1;
    return record;
  }
  void split(uint32_t index) {
    directory.cells[index].firstChild = static_cast<uint32_t>(directory.cells.size());
    for (uint32_t octant = 0; octant < 8; ++octant)
      if (chance(0.7) || octant == 7) {
        directory.cells.push_back(cell(directory.cells[index].key.child(octant), index));
        ++directory.cells[index].childCount;
      }
  }
  void fill(CellRecord& record) {
    if (record.childCount == 0) {
      const GridBox cube = cellBox(directory.model.grid, record.key);
      for (int axis = 0; axis < 3; ++axis) {
        std::uniform_int_distribution<int> place(cube.min[axis], cube.max[axis]);
        const int a = chance(0.3) ? cube.min[axis] : place(random_), b = chance(0.3) ? cube.max[axis] : place(random_);
        record.content.min[axis] = std::min(a, b);
        record.content.max[axis] = std::max(a, b);
      }
      record.triangles = std::uniform_int_distribution<uint64_t>(1, 1000)(random_);
      record.firstGeometryPage = 0;
      record.geometryPageCount = 1;
    }
    for (uint32_t child = record.firstChild; child < record.firstChild + record.childCount; ++child) {
      record.content.include(directory.cells[child].content);
      record.triangles += directory.cells[child].triangles;
    }
  }

  std::mt19937 random_;
};

const Viewpoints& viewpoints() {
  static const Viewpoints set = *Viewpoints::create(42);
  return set;
}

bool isUnder(const Directory& directory, uint32_t cell, uint32_t ancestor) {
  for (; cell != kNone; cell = directory.cells[cell].parent)
    if (cell == ancestor) return true;
  return false;
}

glm::dvec3 worldOf(const Grid& grid, glm::dvec3 unit) { return grid.origin + unit * grid.side; }

// Eyes outside, inside, and exactly on planes and corners of cells, as fractions of the root cube.
std::vector<glm::dvec3> eyes() {
  return {{-2, 0.3, 0.4}, {0.5, 0.5, 4},   {0.5, 0.5, 0.5}, {0.25, 0.25, 0.25}, {0.3, 0.6, 0.1}, {0, 0, 0},
          {1, 0.5, 0.75}, {0.5, -3, 0.25}, {40, 30, 20},    {0.125, 0.7, 2},    {0.5, 0.5, 0}};
}

Camera cameraAt(const Grid& grid, glm::dvec3 eye, glm::dvec3 target, double fovYRad = 0.9) {
  return {"test", worldOf(grid, eye), worldOf(grid, target), {0, 0, 1}, fovYRad};
}

SelectionSettings mode(RenderMode renderMode, uint64_t budget = 500'000) { return {renderMode, budget, kTexelPixels}; }

// First and last parameter of a ray within a box; first > last when it misses.
std::pair<double, double> meet(glm::dvec3 eye, glm::dvec3 ray, const GridBox& box) {
  double first = 0, last = INFINITY;
  for (int axis = 0; axis < 3; ++axis) {
    if (ray[axis] == 0) {
      if (eye[axis] < box.min[axis] || eye[axis] > box.max[axis]) return {1, 0};
      continue;
    }
    double a = (box.min[axis] - eye[axis]) / ray[axis], b = (box.max[axis] - eye[axis]) / ray[axis];
    if (a > b) std::swap(a, b);
    first = std::max(first, a);
    last = std::min(last, b);
  }
  return {first, last};
}

TEST(Selection, aRayMeetsTheCellsOfACutInTheirOrder) {
  const Grid grid{{5, -7, 100}, 64, 24};
  std::mt19937 random(11);
  std::normal_distribution<double> normal;
  for (unsigned seed = 1; seed <= 4; ++seed) {
    const RandomTree tree(seed, grid);
    SCOPED_TRACE(fmt::format("tree {}", seed));
    for (const glm::dvec3 eye : eyes()) {
      const Cut cut = selectCut(tree.directory, viewpoints(), cameraAt(grid, eye, {0.51, 0.52, 0.53}), kWidth, kHeight,
                                mode(RenderMode::full));
      const glm::dvec3 eyeSteps = eye * std::ldexp(1.0, grid.bits);
      for (int i = 0; i < 200; ++i) {
        const glm::dvec3 through = glm::dvec3(normal(random), normal(random), normal(random)) * 0.3 + 0.5;
        const glm::dvec3 ray = through * std::ldexp(1.0, grid.bits) - eyeSteps;
        double reached = -1;
        for (const CutEntry& entry : cut.entries) {
          // Cubes, not contents: the order must hold wherever in its cell a surface lies.
          const auto [first, last] = meet(eyeSteps, ray, cellBox(grid, tree.directory.cells[entry.cell].key));
          if (last - first <= 1e-9 * std::max(1.0, last)) continue;
          EXPECT_GE(first, reached - 1e-9 * std::max(1.0, reached));
          reached = std::max(reached, first);
        }
      }
    }
  }
}

TEST(Selection, aCutCoversEveryVisibleLeafExactlyOnce) {
  const Grid grid{{0, 0, 0}, 1, 24};
  for (unsigned seed = 1; seed <= 6; ++seed) {
    const RandomTree tree(seed, grid);
    const auto& cells = tree.directory.cells;
    for (const glm::dvec3 eye : eyes())
      for (const RenderMode renderMode :
           {RenderMode::automatic, RenderMode::impostors, RenderMode::triangles, RenderMode::full}) {
        SCOPED_TRACE(
            fmt::format("tree {} eye {} {} {} mode {}", seed, eye.x, eye.y, eye.z, static_cast<int>(renderMode)));
        const Camera camera = cameraAt(grid, eye, {0.51, 0.52, 0.53});
        const Cut cut = selectCut(tree.directory, viewpoints(), camera, kWidth, kHeight, mode(renderMode, 3000));
        const CameraAxes axes = cameraAxes(camera);
        const double tanY = std::tan(camera.fovYRad / 2), tanX = tanY * kWidth / kHeight;
        for (uint32_t leaf = 0; leaf < cells.size(); ++leaf) {
          if (cells[leaf].childCount > 0) continue;
          const auto owners = std::count_if(cut.entries.begin(), cut.entries.end(), [&](const CutEntry& entry) {
            return isUnder(tree.directory, leaf, entry.cell);
          });
          EXPECT_LE(owners, 1);
          // A leaf with a point of its content in the picture is seen.
          const glm::dvec3 middle = glm::dvec3(cells[leaf].content.min + cells[leaf].content.max) * (0.5 * grid.step());
          const glm::dvec3 v = middle - camera.position;
          const double depth = -glm::dot(v, axes.back);
          const bool visible = depth > 0 && std::abs(glm::dot(v, axes.right)) < depth * tanX &&
                               std::abs(glm::dot(v, axes.up)) < depth * tanY;
          if (visible || renderMode == RenderMode::full) {
            EXPECT_EQ(owners, 1);
          }
        }
      }
  }
}

TEST(Selection, modesChooseTheirRepresentations) {
  const Grid grid{{0, 0, 0}, 1, 24};
  const RandomTree tree(3, grid);
  const auto& cells = tree.directory.cells;
  for (const glm::dvec3 eye : eyes()) {
    const Camera camera = cameraAt(grid, eye, {0.51, 0.52, 0.53});
    for (const CutEntry& entry :
         selectCut(tree.directory, viewpoints(), camera, kWidth, kHeight, mode(RenderMode::triangles)).entries)
      EXPECT_TRUE(entry.representation == Representation::triangles && cells[entry.cell].childCount == 0);
    for (const CutEntry& entry :
         selectCut(tree.directory, viewpoints(), camera, kWidth, kHeight, mode(RenderMode::impostors)).entries)
      EXPECT_EQ(entry.representation == Representation::impostor, cells[entry.cell].firstViewPage != kNone);
  }
}

TEST(Selection, impostorsKeepTheLevelRuleAndTheNearestView) {
  const Grid grid{{0, 0, 0}, 1, 24};
  const RandomTree tree(4, grid);
  size_t inner = 0;
  for (const glm::dvec3 eye : eyes()) {
    const Camera camera = cameraAt(grid, eye, {0.51, 0.52, 0.53});
    const Cut cut =
        selectCut(tree.directory, viewpoints(), camera, kWidth, kHeight, mode(RenderMode::automatic, 1'000'000'000));
    for (const CutEntry& entry : cut.entries) {
      if (entry.representation != Representation::impostor) continue;
      const CellRecord& cell = tree.directory.cells[entry.cell];
      inner += cell.childCount > 0;
      const glm::dvec3 nearest =
          glm::min(glm::max(eye, grid.worldFromGrid(cell.content.min)), grid.worldFromGrid(cell.content.max));
      const double texel = texelSize(64) * cellHalfSide(grid, cell.key);
      const double pixel = glm::length(eye - nearest) * 2 * std::tan(camera.fovYRad / 2) / kHeight;
      EXPECT_LE(texel, kTexelPixels * pixel * (1 + 1e-9));
      EXPECT_GT(glm::length(eye - cellCentre(grid, cell.key)), std::sqrt(3.0) * cellHalfSide(grid, cell.key));
      const glm::dvec3 middle = glm::dvec3(cell.content.min + cell.content.max) * (0.5 * grid.step());
      EXPECT_EQ(static_cast<int>(entry.view), viewpoints().nearest(eye - middle));
      const Viewpoints::Triple expected = viewpoints().nearestThree(eye - middle);
      EXPECT_EQ(entry.blend.views, expected.views);
      for (size_t i = 0; i < 3; ++i) EXPECT_NEAR(entry.blend.weights[i], expected.weights[i], 1e-9);
    }
  }
  EXPECT_GT(inner, 0u);
}

TEST(Selection, theTriangleBudgetIsKeptAndSpentOnTheLargestTexelsFirst) {
  const Grid grid{{0, 0, 0}, 1, 24};
  for (unsigned seed = 1; seed <= 6; ++seed) {
    const RandomTree tree(seed, grid);
    const auto& cells = tree.directory.cells;
    for (const glm::dvec3 eye : eyes())
      for (const uint64_t budget : {0u, 500u, 5000u, 50000u}) {
        SCOPED_TRACE(fmt::format("tree {} eye {} {} {} budget {}", seed, eye.x, eye.y, eye.z, budget));
        const Cut cut = selectCut(tree.directory, viewpoints(), cameraAt(grid, eye, {0.51, 0.52, 0.53}), kWidth,
                                  kHeight, mode(RenderMode::automatic, budget));
        uint64_t sum = 0, withoutViews = 0;
        double smallestTriangles = INFINITY, largestImpostor = 0;
        for (const CutEntry& entry : cut.entries) {
          const CellRecord& cell = cells[entry.cell];
          const glm::dvec3 nearest =
              glm::min(glm::max(eye, grid.worldFromGrid(cell.content.min)), grid.worldFromGrid(cell.content.max));
          const double distance = glm::length(eye - nearest);
          const double texelPixels =
              texelSize(64) * cellHalfSide(grid, cell.key) / (distance * 2 * std::tan(0.45) / kHeight);
          if (entry.representation == Representation::triangles) {
            sum += cell.triangles;
            if (cell.firstViewPage == kNone) withoutViews += cell.triangles;
            if (cell.firstViewPage != kNone) smallestTriangles = std::min(smallestTriangles, texelPixels);
          } else if (texelPixels > kTexelPixels) {
            largestImpostor = std::max(largestImpostor, texelPixels);
          }
        }
        EXPECT_EQ(sum, cut.triangles);
        EXPECT_LE(cut.triangles, std::max(budget, withoutViews));
        EXPECT_GE(smallestTriangles * (1 + 1e-9), largestImpostor);
      }
  }
}

TEST(Selection, aCutDoesNotDependOnScaleOrOffset) {
  const RandomTree unit(2, Grid{{0, 0, 0}, 1, 24});
  for (const Grid& grid : {Grid{{1e6, -2e6, 5e5}, 1000, 24}, Grid{{0, 0, 0}, 1e-9, 24}, Grid{{1, 2, 3}, 1e12, 24}}) {
    Directory moved = unit.directory;
    moved.model.grid = grid;
    for (const glm::dvec3 eye : {glm::dvec3(-2, 0.31, 0.43), glm::dvec3(0.31, 0.62, 0.13), glm::dvec3(3, 4, 5)}) {
      const auto a =
          selectCut(unit.directory, viewpoints(), cameraAt(unit.directory.model.grid, eye, {0.51, 0.52, 0.53}), kWidth,
                    kHeight, mode(RenderMode::automatic, 5000));
      const auto b = selectCut(moved, viewpoints(), cameraAt(grid, eye, {0.51, 0.52, 0.53}), kWidth, kHeight,
                               mode(RenderMode::automatic, 5000));
      ASSERT_EQ(a.entries.size(), b.entries.size());
      for (size_t i = 0; i < a.entries.size(); ++i) {
        EXPECT_EQ(a.entries[i].cell, b.entries[i].cell);
        EXPECT_EQ(a.entries[i].representation, b.entries[i].representation);
        EXPECT_EQ(a.entries[i].view, b.entries[i].view);
      }
    }
  }
}

TEST(Selection, whatLiesBesideTheFrustumIsCulled) {
  const RandomTree tree(1, Grid{{0, 0, 0}, 1, 24});
  const Camera away = cameraAt(tree.directory.model.grid, {3, 0.5, 0.5}, {9, 0.5, 0.5});
  const Cut cut = selectCut(tree.directory, viewpoints(), away, kWidth, kHeight, mode(RenderMode::automatic));
  EXPECT_TRUE(cut.entries.empty());
  EXPECT_EQ(cut.culled, 1u);
}

}  // namespace
}  // namespace farcell
