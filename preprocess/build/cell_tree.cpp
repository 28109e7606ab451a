#include "preprocess/build/cell_tree.h"

#include <map>

namespace farcell {
namespace {

struct FileOrder {
  bool operator()(const CellKey& a, const CellKey& b) const {
    return a.level != b.level ? a.level < b.level : mortonCode(a) < mortonCode(b);
  }
};

}  // namespace

CellTree cellTreeOf(std::span<const Leaf> leaves, const TriangleLists& triangles) {
  std::map<CellKey, uint32_t, FileOrder> leafOfKey;  // of every cell; kNone for inner ones
  for (size_t leaf = 0; leaf < leaves.size(); ++leaf) {
    leafOfKey[leaves[leaf].key] = static_cast<uint32_t>(leaf);
    for (CellKey key = leaves[leaf].key; key.level > 0;) leafOfKey.try_emplace(key = key.parent(), kNone);
  }
  CellTree tree;
  std::map<CellKey, uint32_t, FileOrder> indexOf;
  for (const auto& [key, leaf] : leafOfKey) {
    const auto index = static_cast<uint32_t>(tree.cells.size());
    indexOf[key] = index;
    CellRecord cell;
    cell.key = key;
    if (key.level > 0) {
      cell.parent = indexOf.at(key.parent());
      CellRecord& parent = tree.cells[cell.parent];
      if (parent.childCount++ == 0) parent.firstChild = index;
    }
    if (leaf != kNone) {
      cell.content = leaves[leaf].content;
      cell.triangles = triangles.size(leaves[leaf].list);
    }
    tree.cells.push_back(cell);
    tree.leafOf.push_back(leaf);
  }
  for (size_t index = tree.cells.size(); index-- > 1;) {  // children lie after their parents
    CellRecord& parent = tree.cells[tree.cells[index].parent];
    parent.content.include(tree.cells[index].content);
    parent.triangles += tree.cells[index].triangles;
  }
  return tree;
}

}  // namespace farcell
