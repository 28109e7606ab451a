// Models, their leaves and their levels of detail, for tests.
#pragma once

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <map>
#include <numbers>
#include <random>
#include <utility>
#include <vector>

#include "preprocess/lod/simplify_cell.h"
#include "preprocess/partition/partition.h"
#include "tests/support/temporary_directory.h"

namespace farcell::test {

class TriangleSource : public MeshReader {
 public:
  explicit TriangleSource(std::vector<InputTriangle> triangles) : triangles_(std::move(triangles)) {
    info_.declaredTriangles = triangles_.size();
    info_.hasColours = true;
  }
  const MeshInfo& info() const override { return info_; }
  std::vector<std::filesystem::path> files() const override { return {}; }
  Result<MeshCounts> forEachTriangle(const Sink& sink) override {
    FARCELL_TRY(sink(triangles_));
    return MeshCounts{triangles_.size(), {}};
  }

 private:
  std::vector<InputTriangle> triangles_;
  MeshInfo info_;
};

inline InputTriangle inputTriangle(glm::dvec3 a, glm::dvec3 b, glm::dvec3 c, uint32_t colour = 0xffffff) {
  InputTriangle triangle{};
  triangle.positions = {a, b, c};
  triangle.colours = {colour, colour, colour};
  return triangle;
}

// Closed, with waves on it; 2 around * along triangles.
inline std::vector<InputTriangle> torus(int around, int along) {
  const auto point = [&](int i, int j) {
    const double u = 2 * std::numbers::pi * (i % around) / around, v = 2 * std::numbers::pi * (j % along) / along;
    const double radius = 0.3 + 0.01 * std::sin(9 * u) * std::cos(7 * v);
    return glm::dvec3((1 + radius * std::cos(v)) * std::cos(u), (1 + radius * std::cos(v)) * std::sin(u),
                      radius * std::sin(v));
  };
  std::vector<InputTriangle> triangles;
  for (int i = 0; i < around; ++i)
    for (int j = 0; j < along; ++j) {
      triangles.push_back(inputTriangle(point(i, j), point(i + 1, j), point(i + 1, j + 1)));
      triangles.push_back(inputTriangle(point(i, j), point(i + 1, j + 1), point(i, j + 1)));
    }
  return triangles;
}

class Random {
 public:
  explicit Random(uint32_t seed) : engine_(seed) {}
  double uniform(double low, double high) { return std::uniform_real_distribution<double>(low, high)(engine_); }
  size_t below(size_t count) { return std::uniform_int_distribution<size_t>(0, count - 1)(engine_); }
  glm::dvec3 point(double reach) { return {uniform(-reach, reach), uniform(-reach, reach), uniform(-reach, reach)}; }

 private:
  std::mt19937 engine_;
};

inline void addBox(std::vector<InputTriangle>& triangles, glm::dvec3 low, glm::dvec3 size) {
  std::array<glm::dvec3, 8> p;
  for (int i = 0; i < 8; ++i) p[size_t(i)] = low + size * glm::dvec3(i & 1, i >> 1 & 1, i >> 2);
  for (const auto& q : {std::array{0, 2, 3, 1}, std::array{4, 5, 7, 6}, std::array{0, 1, 5, 4}, std::array{2, 6, 7, 3},
                        std::array{0, 4, 6, 2}, std::array{1, 3, 7, 5}}) {
    triangles.push_back(inputTriangle(p[size_t(q[0])], p[size_t(q[1])], p[size_t(q[2])]));
    triangles.push_back(inputTriangle(p[size_t(q[0])], p[size_t(q[2])], p[size_t(q[3])]));
  }
}

// Boxes that stand on a square, in streets.
inline std::vector<InputTriangle> city(uint32_t seed, int edge) {
  Random random(seed);
  std::vector<InputTriangle> triangles;
  for (int x = 0; x < edge; ++x)
    for (int y = 0; y < edge; ++y) {
      const glm::dvec3 low(x + random.uniform(0, 0.2), y + random.uniform(0, 0.2), 0);
      const glm::dvec3 size(random.uniform(0.3, 0.7), random.uniform(0.3, 0.7), random.uniform(0.2, 1.5));
      addBox(triangles, low, size);
    }
  return triangles;
}

// Thin and up to four long, one in each unit of a square, along it or across.
inline std::vector<InputTriangle> fences(uint32_t seed, int edge) {
  Random random(seed);
  std::vector<InputTriangle> triangles;
  for (int x = 0; x < edge; ++x)
    for (int y = 0; y < edge; ++y) {
      glm::dvec3 size(0.02, 0.02, 0.3);
      size[static_cast<int>(random.below(2))] = random.uniform(0.5, 4);
      addBox(triangles, {x + random.uniform(0, 0.2), y + random.uniform(0, 0.2), 0}, size);
    }
  return triangles;
}

// Loose triangles: about `size` wide, `size * thinness` thick.
inline std::vector<InputTriangle> looseTriangles(uint32_t seed, int count, double size, double thinness) {
  Random random(seed);
  std::vector<InputTriangle> triangles;
  for (int i = 0; i < count; ++i) {
    const glm::dvec3 a = random.point(1);
    triangles.push_back(inputTriangle(a, a + random.point(size), a + random.point(size * thinness)));
  }
  return triangles;
}

struct Levels {
  Grid grid;
  std::vector<CellKey> leaves;
  std::map<CellKey, SimplifiedCell> cells;  // leaves with error 0, inner cells as simplified
  std::map<CellKey, std::vector<CellKey>> children;
};

inline LodMesh leafMesh(std::span<const GridTriangle> triangles) {
  LodMesh mesh;
  for (const GridTriangle& triangle : triangles)
    for (size_t k = 0; k < 3; ++k) {
      mesh.indices.push_back(static_cast<uint32_t>(mesh.positions.size()));
      mesh.positions.push_back(triangle.corners[k]);
      mesh.colours.push_back(triangle.colours[k]);
    }
  return mesh;
}

// The only place here that knows how a model is cut into leaves.
inline Levels leavesOf(std::vector<InputTriangle> triangles, const BuildSettings& settings) {
  TriangleSource source(std::move(triangles));
  Progress silent(false);
  const TemporaryDirectory directory;
  const PartitionOptions options{directory.path(), 1, kMinPartitionMemoryBytes};
  const Partition partition = partitionMesh(source, settings, options, silent).value();
  Levels levels;
  levels.grid = partition.grid;
  for (const Leaf& leaf : partition.leaves) {
    levels.leaves.push_back(leaf.key);
    levels.cells[leaf.key].mesh = leafMesh(partition.triangles.read(leaf.list).value().triangles);
  }
  return levels;
}

inline SimplifiedCell simplified(const Levels& levels, const CellKey& cell, const LodSettings& settings) {
  std::vector<LodMesh> meshes;
  double error = 0;
  for (const CellKey& child : levels.children.at(cell)) {
    meshes.push_back(levels.cells.at(child).mesh);
    error = std::max(error, levels.cells.at(child).errorSteps);
  }
  return simplifyCell(levels.grid, cell, meshes, error, settings).value();
}

inline Levels levelsOf(std::vector<InputTriangle> triangles, const BuildSettings& settings, const LodSettings& lod) {
  Levels levels = leavesOf(std::move(triangles), settings);
  std::vector<CellKey> below = levels.leaves;
  for (size_t i = 0; i < below.size(); ++i) {
    if (below[i].level == 0) continue;
    std::vector<CellKey>& siblings = levels.children[below[i].parent()];
    if (siblings.empty()) below.push_back(below[i].parent());
    siblings.push_back(below[i]);
  }
  for (uint32_t level = kMaxLevel; level-- > 0;)
    for (const auto& [cell, children] : levels.children)
      if (cell.level == level) levels.cells[cell] = simplified(levels, cell, lod);
  return levels;
}

// All leaves below a cell as one mesh.
inline LodMesh fullMesh(const Levels& levels, const CellKey& cell) {
  LodMesh full;
  for (const CellKey& leaf : levels.leaves) {
    CellKey above = leaf;
    while (above.level > cell.level) above = above.parent();
    if (above != cell) continue;
    const LodMesh& mesh = levels.cells.at(leaf).mesh;
    for (const uint32_t index : mesh.indices) {
      full.indices.push_back(static_cast<uint32_t>(full.positions.size()));
      full.positions.push_back(mesh.positions[index]);
      full.colours.push_back(mesh.colours[index]);
    }
  }
  return full;
}

}  // namespace farcell::test
