#include "tests/bench/lod/tree.h"

#include "preprocess/lod/output.h"
#include "preprocess/read/open_mesh.h"

namespace farcell::bench {
namespace {

constexpr uint64_t kPartitionMemoryBytes = uint64_t{1} << 30;

}  // namespace

Result<Tree> treeOf(const std::filesystem::path& model, int leafTriangles, const std::filesystem::path& scratch) {
  FARCELL_ASSIGN(const auto reader, openMesh(model));
  BuildSettings settings;
  settings.leafTriangles = leafTriangles;
  Progress silent(false);
  FARCELL_ASSIGN(Partition partition, partitionMesh(*reader, settings, {scratch, 2, kPartitionMemoryBytes}, silent));
  Tree tree{std::move(partition), {}, {}};
  for (size_t i = 0; i < tree.partition.leaves.size(); ++i) tree.leaves[tree.partition.leaves[i].key] = i;
  std::vector<CellKey> below;
  for (const auto& [key, index] : tree.leaves) below.push_back(key);
  for (size_t i = 0; i < below.size(); ++i) {
    if (below[i].level == 0) continue;
    std::vector<CellKey>& siblings = tree.children[below[i].parent()];
    if (siblings.empty()) below.push_back(below[i].parent());
    siblings.push_back(below[i]);
  }
  for (auto& [key, siblings] : tree.children)
    std::sort(siblings.begin(), siblings.end(),
              [](const CellKey& a, const CellKey& b) { return a.octant() < b.octant(); });
  return tree;
}

Result<LodMesh> leafMesh(const Tree& tree, const CellKey& leaf) {
  const Partition& partition = tree.partition;
  FARCELL_ASSIGN(const GridTriangles list, partition.triangles.read(partition.leaves[tree.leaves.at(leaf)].list));
  LodMesh soup;
  for (const GridTriangle& triangle : list.triangles) {
    for (size_t k = 0; k < 3; ++k) {
      soup.indices.push_back(static_cast<uint32_t>(soup.positions.size()));
      soup.positions.push_back(triangle.corners[k]);
      soup.colours.push_back(triangle.colours[k]);
    }
  }
  FARCELL_ASSIGN(const lod::WeldedMesh welded, lod::weld(cellBox(partition.grid, leaf), std::span(&soup, 1)));
  lod::Reduction all{welded.places, welded.triangles, {}, {}};
  for (uint32_t i = 0; i < all.triangles.size(); ++i) all.origins.push_back(i);
  return lod::outputMesh(welded, all);
}

std::vector<CellKey> leavesBelow(const Tree& tree, const CellKey& cell) {
  if (tree.leaves.contains(cell)) return {cell};
  std::vector<CellKey> leaves;
  for (const CellKey& child : tree.children.at(cell))
    for (const CellKey& leaf : leavesBelow(tree, child)) leaves.push_back(leaf);
  return leaves;
}

}  // namespace farcell::bench
