// Trees of cells for tests, made from their leaves alone.
#pragma once

#include <map>
#include <utility>
#include <vector>

#include "cache/pack/directory.h"

namespace farcell {

struct TestLeaf {
  CellKey key;
  GridBox content;
  uint64_t triangles = 0;
};

// As a directory has them. `viewPage`: firstViewPage of every cell.
inline std::vector<CellRecord> treeOf(const std::vector<TestLeaf>& leaves, uint32_t viewPage = 0) {
  std::map<std::pair<uint32_t, uint64_t>, CellRecord> byPlace;  // level, then Morton code
  const auto placeOf = [](const CellKey& key) { return std::pair(key.level, mortonCode(key)); };
  for (const TestLeaf& leaf : leaves) {
    for (CellKey key = leaf.key;; key = key.parent()) {
      CellRecord& record = byPlace[placeOf(key)];
      record.key = key;
      record.content.include(leaf.content);
      record.triangles += leaf.triangles;
      record.firstViewPage = viewPage;
      record.viewPageCount = 1;
      if (key.level == 0) break;
    }
  }
  std::map<std::pair<uint32_t, uint64_t>, uint32_t> indices;
  for (const auto& [place, record] : byPlace) indices.emplace(place, static_cast<uint32_t>(indices.size()));
  std::vector<CellRecord> cells;
  for (auto& [place, record] : byPlace) {
    if (record.key.level > 0) {
      record.parent = indices.at(placeOf(record.key.parent()));
      CellRecord& parent = cells[record.parent];
      if (parent.childCount++ == 0) parent.firstChild = indices.at(place);
    }
    cells.push_back(record);
  }
  return cells;
}

}  // namespace farcell
