// A model's leaves and the cells above them, as a build makes them.
#pragma once

#include <filesystem>
#include <map>
#include <vector>

#include "cache/base/result.h"
#include "preprocess/lod/lod_mesh.h"
#include "preprocess/partition/partition.h"

namespace farcell::bench {

struct Tree {
  Partition partition;
  std::map<CellKey, size_t> leaves;                  // index into partition.leaves
  std::map<CellKey, std::vector<CellKey>> children;  // of the inner cells, by level, then by octant
};

// scratch: an empty directory that must outlive the tree.
Result<Tree> treeOf(const std::filesystem::path& model, int leafTriangles, const std::filesystem::path& scratch);
Result<LodMesh> leafMesh(const Tree& tree, const CellKey& leaf);
// The leaves below a cell, itself included.
std::vector<CellKey> leavesBelow(const Tree& tree, const CellKey& cell);

}  // namespace farcell::bench
