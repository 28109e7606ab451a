#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <random>

#include "tests/runtime/selection/random_tree.h"

namespace farcell {
namespace {

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
      const Cut cut =
          selectCut(tree.directory, cameraAt(grid, eye, {0.51, 0.52, 0.53}), kWidth, kHeight, mode(RenderMode::full));
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
      for (const RenderMode renderMode : {RenderMode::automatic, RenderMode::impostors, RenderMode::meshes,
                                          RenderMode::triangles, RenderMode::full}) {
        SCOPED_TRACE(
            fmt::format("tree {} eye {} {} {} mode {}", seed, eye.x, eye.y, eye.z, static_cast<int>(renderMode)));
        const Camera camera = cameraAt(grid, eye, {0.51, 0.52, 0.53});
        const Cut cut = selectCut(tree.directory, camera, kWidth, kHeight, mode(renderMode, 3000));
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
         selectCut(tree.directory, camera, kWidth, kHeight, mode(RenderMode::triangles)).entries)
      EXPECT_TRUE(entry.representation == Representation::triangles && cells[entry.cell].childCount == 0);
    for (const CutEntry& entry :
         selectCut(tree.directory, camera, kWidth, kHeight, mode(RenderMode::impostors)).entries)
      EXPECT_EQ(entry.representation == Representation::impostor, cells[entry.cell].firstViewPage != kNone);
    for (const CutEntry& entry : selectCut(tree.directory, camera, kWidth, kHeight, mode(RenderMode::meshes)).entries) {
      EXPECT_EQ(entry.representation == Representation::triangles, cells[entry.cell].childCount == 0);
      EXPECT_EQ(entry.representation == Representation::mesh, cells[entry.cell].childCount > 0);
    }
  }
}

TEST(Selection, impostorsKeepTheLevelRuleAndTheNearestView) {
  const Grid grid{{0, 0, 0}, 1, 24};
  const RandomTree tree(4, grid);
  size_t inner = 0;
  for (const glm::dvec3 eye : eyes()) {
    const Camera camera = cameraAt(grid, eye, {0.51, 0.52, 0.53});
    const Cut cut = selectCut(tree.directory, camera, kWidth, kHeight, mode(RenderMode::automatic, 1'000'000'000));
    for (const CutEntry& entry : cut.entries) {
      if (entry.representation != Representation::impostor) continue;
      const CellRecord& cell = tree.directory.cells[entry.cell];
      inner += cell.childCount > 0;
      const glm::dvec3 nearest =
          glm::min(glm::max(eye, grid.worldFromGrid(cell.content.min)), grid.worldFromGrid(cell.content.max));
      const double texel = texelSize(cell.form.imageSize) * cellHalfSide(grid, cell.key);
      const double pixel = glm::length(eye - nearest) * 2 * std::tan(camera.fovYRad / 2) / kHeight;
      if (cell.childCount > 0) {
        EXPECT_LE(texel, kTexelPixels * pixel * (1 + 1e-9));
        EXPECT_GT(glm::length(eye - cellCentre(grid, cell.key)), std::sqrt(3.0) * cellHalfSide(grid, cell.key));
      }
      const glm::dvec3 middle = glm::dvec3(cell.content.min + cell.content.max) * (0.5 * grid.step());
      const Viewpoints viewpoints = *Viewpoints::create(cell.form.views);
      EXPECT_EQ(static_cast<int>(entry.view), viewpoints.nearest(eye - middle));
      const Viewpoints::Triple expected = viewpoints.nearestThree(eye - middle);
      EXPECT_EQ(entry.blend.views, expected.views);
      for (size_t i = 0; i < 3; ++i) EXPECT_NEAR(entry.blend.weights[i], expected.weights[i], 1e-9);
    }
  }
  EXPECT_GT(inner, 0u);
}

TEST(Selection, meshesAloneKeepToTheirErrorWithTheFewestTriangles) {
  const Grid grid{{5, -7, 100}, 64, 24};
  size_t meshes = 0, leaves = 0;
  for (unsigned seed = 1; seed <= 6; ++seed) {
    const RandomTree tree(seed, grid);
    for (const glm::dvec3 eye : eyes())
      for (const double meshPixels : {0.5, 1.0, 4.0}) {
        SCOPED_TRACE(fmt::format("tree {} eye {} {} {} pixels {}", seed, eye.x, eye.y, eye.z, meshPixels));
        const Camera camera = cameraAt(grid, eye, {0.51, 0.52, 0.53});
        const SelectionSettings settings = mode(RenderMode::meshes, 0, meshPixels);
        const Cut cut = selectCut(tree.directory, camera, kWidth, kHeight, settings);
        const Oracle oracle(tree.directory, camera, settings);
        for (const CutEntry& entry : cut.entries) {
          const bool mesh = entry.representation == Representation::mesh;
          ++(mesh ? meshes : leaves);
          const double error = mesh ? oracle.meshPixels(entry.cell) : 0;
          EXPECT_LE(error, meshPixels * (1 + 1e-9));
          EXPECT_NEAR(entry.errorPixels, error, 1e-9 * (1 + error));
        }
        EXPECT_EQ(cut.triangles, oracle.fewest(0));
      }
  }
  EXPECT_GT(meshes, 100u);
  EXPECT_GT(leaves, 100u);
}

// Of the lower convex hull of cost over triangles, the best corner within the budget: what a price of triangles
// reaches.
size_t bestCorner(const std::vector<double>& least, size_t budget) {
  std::vector<size_t> hull;
  for (size_t i = 0; i < least.size(); ++i) {
    if (least[i] == INFINITY) continue;
    const auto slope = [&](size_t from, size_t to) { return (least[to] - least[from]) / double(to - from); };
    while (hull.size() > 1 && slope(hull.back(), i) <= slope(hull[hull.size() - 2], hull.back())) hull.pop_back();
    hull.push_back(i);
  }
  size_t best = hull.front();
  for (const size_t corner : hull)
    if (corner <= budget && least[corner] < least[best]) best = corner;
  return best;
}

TEST(Selection, nearlyTheBestOfAllCutsWithinABudgetOfTriangles) {
  const Grid grid{{0, 0, 0}, 1, 24};
  size_t bound = 0, meshes = 0, leaves = 0, impostors = 0;
  double gaps = 0;
  for (unsigned seed = 1; seed <= 10; ++seed) {
    const RandomTree tree(seed, grid, 5);
    for (const glm::dvec3 eye : {glm::dvec3(-2, 0.3, 0.4), glm::dvec3(0.5, 0.5, 4), glm::dvec3(1.2, 0.6, 0.3),
                                 glm::dvec3(0.3, 0.6, 0.1), glm::dvec3(3, -3, 0.25)}) {
      const Camera camera = cameraAt(grid, eye, {0.51, 0.52, 0.53});
      const SelectionSettings plenty = mode(RenderMode::automatic);
      const Oracle oracle(tree.directory, camera, plenty);
      const std::vector<double> least = oracle.leastCost(0, tree.directory.cells[0].triangles);
      for (const uint64_t budget : {0u, 5u, 20u, 60u, 1000000u}) {
        SCOPED_TRACE(fmt::format("tree {} eye {} {} {} budget {}", seed, eye.x, eye.y, eye.z, budget));
        const Cut cut = selectCut(tree.directory, camera, kWidth, kHeight, mode(RenderMode::automatic, budget));
        uint64_t sum = 0;
        for (const CutEntry& entry : cut.entries) {
          meshes += entry.representation == Representation::mesh;
          leaves += entry.representation == Representation::triangles;
          impostors += entry.representation == Representation::impostor;
          if (entry.representation == Representation::impostor) continue;
          sum += tree.directory.cells[entry.cell].meshTriangles;
          EXPECT_LE(oracle.meshPixels(entry.cell), kMeshPixels * (1 + 1e-9));
        }
        EXPECT_EQ(cut.triangles, sum);
        ASSERT_LT(sum, least.size());
        const double cost = oracle.cost(cut);
        EXPECT_NEAR(cut.loss, oracle.loss(cut), 1e-9 * cost);
        EXPECT_GE(cost, least[sum] * (1 - 1e-9));
        const size_t corner = bestCorner(least, budget);
        EXPECT_LE(sum, std::max<uint64_t>(budget, corner));
        EXPECT_LE(cost, least[corner] * (1 + 1e-9));
        if (sum > budget) continue;
        const size_t end = std::min<size_t>(budget + 1, least.size());
        const double best = *std::min_element(least.begin(), least.begin() + static_cast<ptrdiff_t>(end));
        EXPECT_LE(cut.lossBound, cut.loss * (1 + 1e-9));
        EXPECT_LE(cut.lossBound + (cost - cut.loss), best * (1 + 1e-9));
        const bool binds = corner != bestCorner(least, least.size());
        bound += binds;
        gaps += binds ? cost / best - 1 : 0;
      }
    }
  }
  EXPECT_GT(bound, 20u);
  EXPECT_LT(gaps / static_cast<double>(bound), 0.02);
  EXPECT_GT(meshes, 100u);
  EXPECT_GT(leaves, 100u);
  EXPECT_GT(impostors, 100u);
}

TEST(Selection, aCutDoesNotDependOnScaleOrOffset) {
  const RandomTree unit(2, Grid{{0, 0, 0}, 1, 24});
  for (const Grid& grid : {Grid{{1e6, -2e6, 5e5}, 1000, 24}, Grid{{0, 0, 0}, 1e-9, 24}, Grid{{1, 2, 3}, 1e12, 24}}) {
    Directory moved = unit.directory;
    moved.model.grid = grid;
    for (CellRecord& cell : moved.cells) cell.geometricError *= grid.side;  // of the unit tree: model units
    for (const glm::dvec3 eye : {glm::dvec3(-2, 0.31, 0.43), glm::dvec3(0.31, 0.62, 0.13), glm::dvec3(3, 4, 5)}) {
      const auto a = selectCut(unit.directory, cameraAt(unit.directory.model.grid, eye, {0.51, 0.52, 0.53}), kWidth,
                               kHeight, mode(RenderMode::automatic, 5000));
      const auto b =
          selectCut(moved, cameraAt(grid, eye, {0.51, 0.52, 0.53}), kWidth, kHeight, mode(RenderMode::automatic, 5000));
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
  const Cut cut = selectCut(tree.directory, away, kWidth, kHeight, mode(RenderMode::automatic));
  EXPECT_TRUE(cut.entries.empty());
  EXPECT_EQ(cut.culled, 1u);
}

}  // namespace
}  // namespace farcell
