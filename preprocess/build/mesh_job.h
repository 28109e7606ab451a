// Jobs that make the meshes of cells: a leaf's full triangles; of inner cells, from the bottom up, simplified ones.
#pragma once

#include <cstdint>
#include <vector>

#include "preprocess/build/build_context.h"

namespace farcell {

// Codes and stores the triangles of a leaf, in parts. textures as for bakeBatch: each part gets an atlas of them.
Result<> codeLeaf(const BuildContext& context, uint32_t cell, TextureSampler* textures);

// Simplifies the meshes of an inner cell's children, which are stored, codes and stores the result. The cell gets no
// mesh where the children's have more than so many times the triangles that a leaf may have (below it a leaf that no
// plane could split), or where a child that holds something has none.
inline constexpr uint64_t kMaxSimplifiedLeaves = 8;
Result<> simplifyInner(const BuildContext& context, uint32_t cell);

// Leaves; and inner cells by level, the deepest first: jobs of one list do not depend on each other, but on the lists
// before it.
std::vector<uint32_t> leavesOf(const CellTree& tree);
std::vector<std::vector<uint32_t>> innerCellsFromTheBottom(const CellTree& tree);

}  // namespace farcell
