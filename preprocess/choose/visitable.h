// Which views of a cell anybody can get who keeps to a region: those that are nearest or second nearest to the
// direction from the cell to some place of the region from which the runtime draws the cell's views (standing.h). What
// is said to be unseen never is seen; a few views may be called seen that are not.
//
// Directions are handled as cones about an axis: within half an angle b of an axis a, a view can be among the nearest
// two only if it lies within (second nearest at a) + 2 b of a.
#pragma once

#include <span>
#include <vector>

#include "cache/schema/viewpoints.h"
#include "preprocess/choose/ground.h"
#include "preprocess/choose/region.h"

namespace farcell {

using ViewMask = std::vector<bool>;  // by view

class Visitable {
 public:
  // Needs the tree alone: a view that nobody can get need not be baked. `viewpoints` is copied.
  Visitable(const Region& region, const Model& model, std::span<const CellRecord> cells, const Viewpoints& viewpoints);

  // Thread-safe; microseconds to milliseconds. Nothing is seen of a cell without content.
  ViewMask seen(const CellRecord& cell) const;
  bool canBeSeen(const CellRecord& cell, int view) const { return seen(cell)[static_cast<size_t>(view)]; }

 private:
  // Boxes of the region, grid steps, as a tree: node 0 is the root.
  struct Box {
    glm::dvec3 min{0}, max{0};
    uint32_t first = 0, second = 0;  // nodes; 0: a leaf
  };
  class Look;
  uint32_t addNode(std::span<Box> boxes);
  void findHighest(int up);

  Region::Kind kind_;
  Grid grid_;
  Viewpoints viewpoints_;
  Ground ground_;
  std::vector<Box> nodes_;
  std::vector<double> highestSine_;  // by view: of the elevation of directions for which it is one of the nearest two
  double finestRad_ = 0;             // cones narrower than this are not split
};

}  // namespace farcell
