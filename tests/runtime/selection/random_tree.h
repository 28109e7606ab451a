// Random octrees to select from, and what cuts of them cost by plain recursion.
#pragma once

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <random>
#include <vector>

#include "cache/schema/view_frame.h"
#include "runtime/selection/loss.h"
#include "runtime/selection/selection.h"

namespace farcell {

inline constexpr int kWidth = 320, kHeight = 240;

// A random adaptive tree over a grid: leaves at several levels, some octants empty, some cells without views, some
// inner cells without a mesh.
class RandomTree {
 public:
  RandomTree(unsigned seed, const Grid& grid, uint64_t mostTriangles = 1000)
      : random_(seed), mostTriangles_(mostTriangles) {
    directory.model.grid = grid;
    directory.pages.push_back({.storedBytes = 1000});  // of every cell
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
    record.form = kForms[record.triangles % kForms.size()];
  }
  static constexpr std::array<ViewForm, 4> kForms = {{{12, 64}, {42, 64}, {162, 32}, {42, 128}}};

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

inline bool isUnder(const Directory& directory, uint32_t cell, uint32_t ancestor) {
  for (; cell != kNone; cell = directory.cells[cell].parent)
    if (cell == ancestor) return true;
  return false;
}

inline glm::dvec3 worldOf(const Grid& grid, glm::dvec3 unit) { return grid.origin + unit * grid.side; }

// Eyes outside, inside, and exactly on planes and corners of cells, as fractions of the root cube.
inline std::vector<glm::dvec3> eyes() {
  return {{-2, 0.3, 0.4}, {0.5, 0.5, 4},   {0.5, 0.5, 0.5}, {0.25, 0.25, 0.25}, {0.3, 0.6, 0.1}, {0, 0, 0},
          {1, 0.5, 0.75}, {0.5, -3, 0.25}, {40, 30, 20},    {0.125, 0.7, 2},    {0.5, 0.5, 0}};
}

inline Camera cameraAt(const Grid& grid, glm::dvec3 eye, glm::dvec3 target, double fovYRad = 0.9) {
  return {"test", worldOf(grid, eye), worldOf(grid, target), {0, 0, 1}, fovYRad};
}

inline SelectionSettings mode(RenderMode renderMode, uint64_t budget = 500'000, double meshPixels = kMeshPixels) {
  SelectionSettings settings;
  settings.mode = renderMode;
  settings.triangleBudget = budget;
  settings.meshPixels = meshPixels;
  return settings;
}

// What the ways to draw a cell lose, in the world's own lengths, and the best of all cuts by plain recursion.
class Oracle {
 public:
  Oracle(const Directory& directory, const Camera& camera, const SelectionSettings& settings)
      : directory_(directory), camera_(camera), settings_(settings), visible_(directory.cells.size(), false) {
    // What is in the frustum is not this oracle's business: culling has its own tests.
    for (const CutEntry& entry : selectCut(directory, camera, kWidth, kHeight, mode(RenderMode::triangles)).entries)
      for (uint32_t cell = entry.cell; cell != kNone; cell = directory.cells[cell].parent) visible_[cell] = true;
  }

  double texelPixels(uint32_t cell) const {
    const CellRecord& record = directory_.cells[cell];
    return pixels(cell, texelSize(record.form.imageSize) * cellHalfSide(directory_.model.grid, record.key));
  }
  double meshPixels(uint32_t cell) const {
    const double error = directory_.cells[cell].geometricError;
    return error == 0 ? 0 : pixels(cell, error);
  }

  double loss(uint32_t cell, Representation representation) const {
    const CellRecord& record = directory_.cells[cell];
    return areaPixels(cell) * (representation == Representation::impostor
                                   ? impostorLoss(record, texelPixels(cell))
                                   : meshLoss(record, texelPixels(cell), meshPixels(cell),
                                              static_cast<double>(record.triangles) / areaPixels(cell)));
  }
  // And the price of its time.
  double cost(uint32_t cell, Representation representation) const {
    const DrawCosts& costs = settings_.costs;
    const double ms = representation == Representation::impostor
                          ? costs.impostorMs + costs.impostorPixelMs * boxPixels(cell)
                          : costs.triangleMs * static_cast<double>(directory_.cells[cell].meshTriangles) +
                                costs.meshPixelMs * boxPixels(cell);
    return loss(cell, representation) + kMillisecondPrice * ms;
  }
  double loss(const Cut& cut) const {
    double sum = 0;
    for (const CutEntry& entry : cut.entries) sum += loss(entry.cell, entry.representation);
    return sum;
  }
  double cost(const Cut& cut) const {
    double sum = 0;
    for (const CutEntry& entry : cut.entries) sum += cost(entry.cell, entry.representation);
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

  // By number of triangles 0..most: the least cost of all cuts of so many; infinite where there is none.
  std::vector<double> leastCost(uint32_t cell, size_t most) const {
    const CellRecord& record = directory_.cells[cell];
    std::vector<double> least(most + 1, INFINITY);
    const auto offer = [&](uint64_t triangles, double cost) {
      if (triangles <= most) least[triangles] = std::min(least[triangles], cost);
    };
    if (!visible_[cell]) {
      offer(0, 0);
      return least;
    }
    const bool views = record.firstViewPage != kNone;
    if (views && (isFar(cell) || record.childCount == 0)) offer(0, cost(cell, Representation::impostor));
    if (views && isClosed(cell)) return least;
    if (record.childCount == 0 || meshAllowed(cell)) offer(record.meshTriangles, cost(cell, Representation::mesh));
    if (record.childCount == 0) return least;
    std::vector<double> below(most + 1, INFINITY);
    below[0] = 0;
    for (uint32_t child = 0; child < record.childCount; ++child) {
      const std::vector<double> one = leastCost(record.firstChild + child, most);
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
    return boxPixels(cell);
  }
  double boxPixels(uint32_t cell) const {
    const CellRecord& record = directory_.cells[cell];
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

}  // namespace farcell
