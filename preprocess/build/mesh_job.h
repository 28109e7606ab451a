// Jobs that make the meshes of cells: a leaf's full triangles, and for inner cells, from the bottom up, simplified ones.
#pragma once

#include <cstdint>
#include <vector>

#include "preprocess/build/build_context.h"

namespace farcell {

// Codes and stores the triangles of a leaf, in parts. textures as for bakeBatch: they become colours of vertices.
Result<> codeLeaf(const BuildContext& context, uint32_t cell, TextureSampler* textures);

// Leaves; and inner cells by level, the deepest first: jobs of one list do not depend on each other.
std::vector<uint32_t> leavesOf(const CellTree& tree);
std::vector<std::vector<uint32_t>> innerCellsFromTheBottom(const CellTree& tree);

}  // namespace farcell
