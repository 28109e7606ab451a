#include "runtime/selection/selection.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <map>
#include <random>
#include <set>

#include "cache/schema/view_frame.h"
#include "runtime/selection/losses.h"

namespace farcell {
namespace {

constexpr int kWidth = 320, kHeight = 240;

// A random adaptive tree over a grid: leaves at several levels, some octants empty, some cells without views, some
// inner cells without a mesh.
class RandomTree {
 public:
  RandomTree(unsigned seed, const Grid& grid, uint64_t mostTriangles = 1000)
      : random_(seed), mostTriangles_(mostTriangles) {
    directory.model.grid = grid;
    directory.model.settings.imageSize = 64;
    directory.cells.push_back(cell({}, kNone));
    for (uint32_t i = 0; i < directory.cells.size(); ++i)
      if (directory.cells[i].key.level < 4 && (i < 3 || chance(0.4))) split(i);
    for (size_t i = directory.cells.size(); i-- > 0;) fill(directory.cells[i]);
  }

  Directory directory;

 private:
  bool chance(double p) { return part() < p; }

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
      record.triangles = std::uniform_int_distribution<uint64_t>(1, mostTriangles_)(random_);
      record.meshTriangles = record.triangles;
      record.firstGeometryPage = 0;
      record.geometryPageCount = 1;
    }
    for (uint32_t child = record.firstChild; child < record.firstChild + record.childCount; ++child) {
      record.content.include(directory.cells[child].content);
      record.triangles += directory.cells[child].triangles;
    }
    if (record.childCount > 0 && chance(0.8)) {
      record.meshTriangles = std::uniform_int_distribution<uint64_t>(1, record.triangles)(random_);
      record.geometricError = chance(0.1) ? 0 : cellHalfSide(directory.model.grid, record.key) * std::exp2(-8 * part());
      record.firstGeometryPage = 0;
      record.geometryPageCount = 1;
    }
    if (record.triangles % 2 == 0) measure(record);
  }
  // Errors of any shape.
  static void measure(CellRecord& record) {
    for (size_t scale = 0; scale < kErrorScales; ++scale) {
      const auto code = [&](uint64_t factor) {
        return static_cast<uint8_t>(100 + (record.triangles * factor + 29 * scale) % 100);
      };
      if (record.meshTriangles > 0) record.errors.codes[static_cast<size_t>(ErrorWay::mesh)][scale] = code(31);
      if (record.viewPageCount > 0)
        record.errors.codes[static_cast<size_t>(ErrorWay::depthCorrected)][scale] = code(47);
    }
  }
  double part() { return std::uniform_real_distribution<double>(0, 1)(random_); }

  std::mt19937 random_;
  uint64_t mostTriangles_;
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

SelectionSettings mode(RenderMode renderMode, uint64_t budget = 500'000, double meshPixels = kMeshPixels) {
  return {renderMode, budget, kTexelPixels, meshPixels};
}

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
      for (const RenderMode renderMode : {RenderMode::automatic, RenderMode::impostors, RenderMode::meshes,
                                          RenderMode::triangles, RenderMode::full}) {
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
    for (const CutEntry& entry :
         selectCut(tree.directory, viewpoints(), camera, kWidth, kHeight, mode(RenderMode::meshes)).entries) {
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
      if (cell.childCount > 0) {
        EXPECT_LE(texel, kTexelPixels * pixel * (1 + 1e-9));
        EXPECT_GT(glm::length(eye - cellCentre(grid, cell.key)), std::sqrt(3.0) * cellHalfSide(grid, cell.key));
      }
      const glm::dvec3 middle = glm::dvec3(cell.content.min + cell.content.max) * (0.5 * grid.step());
      EXPECT_EQ(static_cast<int>(entry.view), viewpoints().nearest(eye - middle));
      const Viewpoints::Triple expected = viewpoints().nearestThree(eye - middle);
      EXPECT_EQ(entry.blend.views, expected.views);
      for (size_t i = 0; i < 3; ++i) EXPECT_NEAR(entry.blend.weights[i], expected.weights[i], 1e-9);
    }
  }
  EXPECT_GT(inner, 0u);
}

// What the ways to draw a cell lose, in the world's own lengths, and the best of all cuts by plain recursion.
class Oracle {
 public:
  Oracle(const Directory& directory, const Camera& camera, const SelectionSettings& settings)
      : directory_(directory), camera_(camera), settings_(settings), visible_(directory.cells.size(), false) {
    // What is in the frustum is not this oracle's business: culling has its own tests.
    for (const CutEntry& entry :
         selectCut(directory, viewpoints(), camera, kWidth, kHeight, mode(RenderMode::triangles)).entries)
      for (uint32_t cell = entry.cell; cell != kNone; cell = directory.cells[cell].parent) visible_[cell] = true;
  }

  double texelPixels(uint32_t cell) const {
    return pixels(cell, texelSize(64) * cellHalfSide(directory_.model.grid, directory_.cells[cell].key));
  }
  double meshPixels(uint32_t cell) const {
    const double error = directory_.cells[cell].geometricError;
    return error == 0 ? 0 : pixels(cell, error);
  }

  // Of the representation, without the price of its triangles.
  double loss(uint32_t cell, Representation representation) const {
    return areaPixels(cell) *
           (representation == Representation::impostor
                ? impostorLoss(directory_.cells[cell], texelPixels(cell)) + kTrianglePrice * kTrianglesPerPixel
                : meshLoss(directory_.cells[cell], texelPixels(cell), meshPixels(cell)));
  }
  double loss(const Cut& cut) const {
    double sum = 0;
    for (const CutEntry& entry : cut.entries) sum += loss(entry.cell, entry.representation);
    return sum;
  }

  // The fewest triangles of all cuts of meshes alone.
  uint64_t fewest(uint32_t cell) const {
    const CellRecord& record = directory_.cells[cell];
    if (!visible_[cell]) return 0;
    if (record.childCount == 0) return record.triangles;
    uint64_t below = 0;
    for (uint32_t child = 0; child < record.childCount; ++child) below += fewest(record.firstChild + child);
    return meshAllowed(cell) ? std::min(below, record.meshTriangles) : below;
  }

  // By number of triangles 0..most: the least loss of all cuts of so many; infinite where there is none.
  std::vector<double> leastLoss(uint32_t cell, size_t most) const {
    const CellRecord& record = directory_.cells[cell];
    std::vector<double> least(most + 1, INFINITY);
    const auto offer = [&](uint64_t triangles, double loss) {
      if (triangles <= most) least[triangles] = std::min(least[triangles], loss);
    };
    if (!visible_[cell]) {
      offer(0, 0);
      return least;
    }
    const bool views = record.firstViewPage != kNone;
    if (views && (isFar(cell) || record.childCount == 0)) offer(0, loss(cell, Representation::impostor));
    if (views && isClosed(cell)) return least;
    if (record.childCount == 0 || meshAllowed(cell)) offer(record.meshTriangles, loss(cell, Representation::mesh));
    if (record.childCount == 0) return least;
    std::vector<double> below(most + 1, INFINITY);
    below[0] = 0;
    for (uint32_t child = 0; child < record.childCount; ++child) {
      const std::vector<double> one = leastLoss(record.firstChild + child, most);
      std::vector<double> sum(most + 1, INFINITY);
      for (size_t a = 0; a <= most; ++a)
        for (size_t b = 0; a + b <= most && below[a] < INFINITY; ++b)
          sum[a + b] = std::min(sum[a + b], below[a] + one[b]);
      below = std::move(sum);
    }
    for (size_t i = 0; i <= most; ++i) offer(i, below[i]);
    return least;
  }

 private:
  bool meshAllowed(uint32_t cell) const {
    return directory_.cells[cell].firstGeometryPage != kNone && meshPixels(cell) <= settings_.meshPixels;
  }
  bool isFar(uint32_t cell) const {
    const Grid& grid = directory_.model.grid;
    const CellKey& key = directory_.cells[cell].key;
    return texelPixels(cell) <= settings_.texelPixels &&
           glm::length(camera_.position - cellCentre(grid, key)) > std::sqrt(3.0) * cellHalfSide(grid, key);
  }
  // Drawn by its views, whatever else there is.
  bool isClosed(uint32_t cell) const {
    const bool measured = directory_.cells[cell].errors.knows(ErrorWay::depthCorrected);
    return isFar(cell) && !(measured && texelPixels(cell) > settings_.texelPixels / 2);
  }
  double pixels(uint32_t cell, double length) const {
    const Grid& grid = directory_.model.grid;
    const GridBox& box = directory_.cells[cell].content;
    const glm::dvec3 nearest =
        glm::min(glm::max(camera_.position, grid.worldFromGrid(box.min)), grid.worldFromGrid(box.max));
    return length * kHeight / (glm::length(camera_.position - nearest) * 2 * std::tan(camera_.fovYRad / 2));
  }
  // A mean silhouette of the content, or of what is drawn below.
  double areaPixels(uint32_t cell) const {
    const CellRecord& record = directory_.cells[cell];
    if (record.childCount > 0 && !(record.firstViewPage != kNone && isClosed(cell))) {
      double sum = 0;
      for (uint32_t child = 0; child < record.childCount; ++child)
        if (visible_[record.firstChild + child]) sum += areaPixels(record.firstChild + child);
      return sum;
    }
    const glm::dvec3 size = glm::dvec3(record.content.max - record.content.min) * directory_.model.grid.step();
    const double x = pixels(cell, size.x), y = pixels(cell, size.y), z = pixels(cell, size.z);
    const double area = (x * y + y * z + z * x) / 2;
    return area < kWidth * kHeight ? area : kWidth * kHeight;
  }

  const Directory& directory_;
  const Camera& camera_;
  const SelectionSettings& settings_;
  std::vector<bool> visible_;
};

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
        const Cut cut = selectCut(tree.directory, viewpoints(), camera, kWidth, kHeight, settings);
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

// Corners of the lower convex hull of loss over triangles, up to `budget`: what a price of triangles can choose.
size_t lastCorner(const std::vector<double>& least, size_t budget) {
  std::vector<size_t> hull;
  for (size_t i = 0; i < least.size(); ++i) {
    if (least[i] == INFINITY) continue;
    const auto slope = [&](size_t from, size_t to) { return (least[to] - least[from]) / double(to - from); };
    while (hull.size() > 1 && slope(hull.back(), i) <= slope(hull[hull.size() - 2], hull.back())) hull.pop_back();
    hull.push_back(i);
  }
  size_t last = hull.front();
  for (size_t i = 1; i < hull.size() && hull[i] <= budget; ++i) {
    // Beyond the price that a triangle always has, no more of them.
    if ((least[hull[i - 1]] - least[hull[i]]) / double(hull[i] - hull[i - 1]) < kTrianglePrice) break;
    last = hull[i];
  }
  return last;
}

TEST(Selection, noCutOfAsFewTrianglesLosesLess) {
  const Grid grid{{0, 0, 0}, 1, 24};
  size_t bound = 0, meshes = 0, leaves = 0, impostors = 0;
  for (unsigned seed = 1; seed <= 10; ++seed) {
    const RandomTree tree(seed, grid, 5);
    for (const glm::dvec3 eye : {glm::dvec3(-2, 0.3, 0.4), glm::dvec3(0.5, 0.5, 4), glm::dvec3(1.2, 0.6, 0.3),
                                 glm::dvec3(0.3, 0.6, 0.1), glm::dvec3(3, -3, 0.25)}) {
      const Camera camera = cameraAt(grid, eye, {0.51, 0.52, 0.53});
      const SelectionSettings plenty = mode(RenderMode::automatic);
      const Oracle oracle(tree.directory, camera, plenty);
      const std::vector<double> least = oracle.leastLoss(0, tree.directory.cells[0].triangles);
      for (const uint64_t budget : {0u, 5u, 20u, 60u, 1000000u}) {
        SCOPED_TRACE(fmt::format("tree {} eye {} {} {} budget {}", seed, eye.x, eye.y, eye.z, budget));
        const Cut cut =
            selectCut(tree.directory, viewpoints(), camera, kWidth, kHeight, mode(RenderMode::automatic, budget));
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
        EXPECT_NEAR(oracle.loss(cut), least[sum], 1e-9 * least[sum]);
        const size_t corner = lastCorner(least, budget);
        bound += corner == lastCorner(least, least.size()) ? 0 : 1;
        EXPECT_LE(oracle.loss(cut), least[corner] * (1 + 1e-9));
        EXPECT_LE(sum, std::max<uint64_t>(budget, corner));
      }
    }
  }
  EXPECT_GT(bound, 20u);
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
