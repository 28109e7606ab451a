// The triangles of a grown cell, in the cell's own coordinates, ready to bake.
#pragma once

#include <functional>
#include <span>

#include "preprocess/bake/view_baker.h"
#include "preprocess/build/cell_tree.h"

namespace farcell {

// Which leaves have content inside a grown cell, and their triangles, cut to it. Any thread.
class SoupSource {
 public:
  SoupSource(const Model& model, const CellTree& tree, const Partition& partition)
      : model_(model), tree_(tree), partition_(partition) {}

  // Those with content inside the grown cell; indices of cells of the tree, rising.
  std::vector<uint32_t> leavesInside(uint32_t cell) const;
  // Those that the cell itself is made of, likewise.
  std::vector<uint32_t> leavesBelow(uint32_t cell) const;
  // Appends the part of `leafCell` that lies in the grown cube of `cell`, and calls `appended` after each portion of a
  // few thousand triangles: it may use up and clear the soup.
  Result<> append(uint32_t cell, uint32_t leafCell, CellSoup& soup, const std::function<Result<>()>& appended) const;

 private:
  const Model& model_;
  const CellTree& tree_;
  const Partition& partition_;
};

}  // namespace farcell
