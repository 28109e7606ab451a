// Where a triangle goes in one pass: the smallest cell, down to some levels below a root cell, that holds it whole.
//
// Buckets are the cells of all those levels, numbered from the root down, each before its children (preorder): the
// triangles inside any cell are one range of buckets. Which of two cells gets what touches the plane between them is
// the rule of cutAt (grid_triangle.h).
#pragma once

#include <array>
#include <bit>
#include <cstdint>
#include <span>

#include "cache/schema/grid.h"
#include "preprocess/partition/record_format.h"

namespace farcell {

class BucketLayout {
 public:
  static constexpr int kMaxDepth = 5;
  // Levels below the root, at most kMaxDepth.
  BucketLayout(const CellKey& root, int gridBits, int depth);

  int depth() const { return depth_; }
  size_t count() const { return subtree_[0]; }
  // Buckets of a cell and all below it; `level` counts from the root.
  size_t subtree(int level) const { return subtree_[level]; }
  size_t child(size_t bucket, int level, size_t octant) const { return bucket + 1 + octant * subtree_[level + 1]; }

  uint16_t bucketOf(const Corners& corners) const {
    uint32_t differ = 0;
    std::array<uint32_t, 3> low;
    for (int axis = 0; axis < 3; ++axis) {
      const int32_t a = corners[0][axis], b = corners[1][axis], c = corners[2][axis];
      const int32_t min = std::min(std::min(a, b), c), max = std::max(std::max(a, b), c);
      low[axis] = cellOf(min, axis);
      differ |= low[axis] ^ cellOf(max - (max > min), axis);
    }
    const int up = std::bit_width(differ);
    const uint32_t mask = ~uint32_t{0} << up;
    return static_cast<uint16_t>(depth_ - up + offset_[0][low[0] & mask] + offset_[1][low[1] & mask] +
                                 offset_[2][low[2] & mask]);
  }

 private:
  // Of the deepest level, along an axis. The root's far face belongs to the last cell.
  uint32_t cellOf(int32_t position, int axis) const {
    return std::min(static_cast<uint32_t>((position - origin_[axis]) >> shift_), cells_ - 1);
  }

  int depth_;
  int shift_;
  uint32_t cells_;
  GridPoint origin_;
  std::array<size_t, kMaxDepth + 1> subtree_{};
  std::array<std::array<uint16_t, size_t{1} << kMaxDepth>, 3> offset_{};
};

// Records in the order of their buckets, those of a bucket in the order they came. codes: one a record, overwritten;
// starts: one a bucket and one more, where each begins in `out`. Returns the box of all.
GridBox sortByBucket(const BucketLayout& layout, const RecordFormat& format, std::span<const std::byte> records,
                     std::byte* out, std::span<uint16_t> codes, std::span<uint32_t> starts);

}  // namespace farcell
