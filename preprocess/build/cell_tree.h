// The octree over the leaves: every cell from the root down to them, as a pack's directory keeps it.
#pragma once

#include <span>
#include <vector>

#include "cache/pack/directory.h"
#include "preprocess/partition/partition.h"

namespace farcell {

struct CellTree {
  std::vector<CellRecord> cells;  // by level, then Morton code; pages not yet filled in
  std::vector<uint32_t> leafOf;   // per cell: index of its leaf, kNone for inner cells
};

CellTree cellTreeOf(std::span<const Leaf> leaves, const TriangleLists& triangles);

}  // namespace farcell
