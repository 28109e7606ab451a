// Cells of any levels, side by side.
#include <gtest/gtest.h>

#include <array>
#include <tuple>

#include "tests/preprocess/lod/lod_models.h"

namespace farcell {
namespace {

using test::Levels;

// How often each edge is passed in its direction less how often against it: 0 where a surface goes on.
class EdgeSums {
 public:
  void add(const LodMesh& mesh) {
    for (size_t i = 0; i < mesh.indices.size(); i += 3)
      for (size_t k = 0; k < 3; ++k)
        add(mesh.positions[mesh.indices[i + k]], mesh.positions[mesh.indices[i + (k + 1) % 3]]);
  }
  std::map<std::array<int32_t, 6>, int> open() const {
    std::map<std::array<int32_t, 6>, int> result;
    for (const auto& [edge, sum] : sums_)
      if (sum != 0) result[edge] = sum;
    return result;
  }

 private:
  void add(GridPoint a, GridPoint b) {
    const std::array<int32_t, 6> there = {a.x, a.y, a.z, b.x, b.y, b.z}, back = {b.x, b.y, b.z, a.x, a.y, a.z};
    if (there < back)
      ++sums_[there];
    else
      --sums_[back];
  }
  std::map<std::array<int32_t, 6>, int> sums_;
};

void addCut(const Levels& levels, const CellKey& cell, test::Random& random, double stop, EdgeSums& edges, int& used) {
  const auto children = levels.children.find(cell);
  if (children == levels.children.end() || random.uniform(0, 1) < stop) {
    edges.add(levels.cells.at(cell).mesh);
    ++used;
    return;
  }
  for (const CellKey& child : children->second) addCut(levels, child, random, stop, edges, used);
}

void expectClosedCuts(const Levels& levels) {
  const uint32_t seed = std::random_device{}();
  SCOPED_TRACE(seed);
  test::Random random(seed);
  int used = 0;
  for (int cut = 0; cut < 20; ++cut) {
    EdgeSums edges;
    addCut(levels, CellKey{}, random, cut == 0 ? 0 : 0.3, edges, used);
    EXPECT_EQ(edges.open().size(), 0u) << "cut " << cut;
  }
  EXPECT_GT(used, 40);
}

BuildSettings evenLeaves(int level) {
  BuildSettings settings;
  settings.fixedLevel = level;
  return settings;
}

TEST(LodCuts, AClosedModelIsClosedInEveryCut) {
  const Levels levels = test::levelsOf(test::torus(160, 60), evenLeaves(3), {.targetTriangles = 150});
  EXPECT_LT(levels.cells.at({}).mesh.triangles(), 160u);
  expectClosedCuts(levels);
}

TEST(LodCuts, AClosedModelIsClosedInEveryCutByOpenMesh) {
  const Levels levels =
      test::levelsOf(test::torus(100, 40), evenLeaves(2), {.targetTriangles = 400, .simplifier = Simplifier::openmesh});
  for (const auto& [cell, children] : levels.children) EXPECT_FALSE(levels.cells.at(cell).figures.fellBack);
  expectClosedCuts(levels);
}

// Where a leaf meets deeper ones, its edges in the shared face are not cut where theirs are; above, the slits are
// closed.
TEST(LodCuts, ACellOfLeavesOfDifferentDepthIsClosed) {
  BuildSettings settings;
  settings.leafTriangles = 400;
  const Levels levels = test::levelsOf(test::torus(90, 70), settings, {.targetTriangles = 300});
  EXPECT_LT(levels.leaves.front().level, levels.leaves.back().level);
  EdgeSums leaves, root;
  for (const CellKey& leaf : levels.leaves) leaves.add(levels.cells.at(leaf).mesh);
  EXPECT_GT(leaves.open().size(), 0u);
  root.add(levels.cells.at({}).mesh);
  EXPECT_EQ(root.open().size(), 0u);
}

// How often each directed edge in a face of the cell's cube is a triangle's.
std::map<std::array<int32_t, 6>, int> edgesInFaces(const GridBox& box, std::span<const LodMesh> meshes) {
  std::map<std::array<int32_t, 6>, int> counts;
  const auto inFace = [&](GridPoint a, GridPoint b) {
    for (int axis = 0; axis < 3; ++axis)
      if (a[axis] == b[axis] && (a[axis] == box.min[axis] || a[axis] == box.max[axis])) return true;
    return false;
  };
  for (const LodMesh& mesh : meshes)
    for (size_t i = 0; i < mesh.indices.size(); i += 3) {
      const std::array<GridPoint, 3> p = {mesh.positions[mesh.indices[i]], mesh.positions[mesh.indices[i + 1]],
                                          mesh.positions[mesh.indices[i + 2]]};
      if (p[0] == p[1] || p[1] == p[2] || p[2] == p[0]) continue;
      for (size_t k = 0; k < 3; ++k)
        if (const GridPoint a = p[k], b = p[(k + 1) % 3]; inFace(a, b)) ++counts[{a.x, a.y, a.z, b.x, b.y, b.z}];
    }
  return counts;
}

TEST(LodCuts, EdgesInTheCellsFacesStayWhateverTheMesh) {
  const uint32_t seed = std::random_device{}();
  SCOPED_TRACE(seed);
  test::Random random(seed);
  const Grid grid;
  const CellKey cell{20, 5, 6, 7};  // 16 steps wide: places coincide, edges are shared by many
  const GridBox box = cellBox(grid, cell);
  size_t edges = 0, simplified = 0;
  for (int round = 0; round < 300; ++round) {
    std::vector<LodMesh> children(1 + random.below(3));
    for (LodMesh& mesh : children) {
      for (int i = 0; i < 30; ++i)
        mesh.positions.push_back(box.min + GridPoint(i % 2 * random.below(17), random.below(17), random.below(17)));
      for (int i = 0; i < 3 * 60; ++i) mesh.indices.push_back(static_cast<uint32_t>(random.below(30)));
    }
    const SimplifiedCell result = simplifyCell(grid, cell, children, 0, {.targetTriangles = random.below(40)}).value();
    const auto before = edgesInFaces(box, children), after = edgesInFaces(box, std::span(&result.mesh, 1));
    edges += before.size();
    for (const auto& [edge, count] : before) EXPECT_TRUE(after.contains(edge) && after.at(edge) >= count);
    simplified += result.mesh.triangles() < result.figures.childTriangles;
  }
  EXPECT_GT(edges, 1000u);
  EXPECT_GT(simplified, 200u);
}

}  // namespace
}  // namespace farcell
