// Splits a cell whose contents fit in memory, down to its leaves.
#pragma once

#include <span>

#include "preprocess/partition/bucket_layout.h"
#include "preprocess/partition/leaf_store.h"
#include "preprocess/partition/page_buffer.h"
#include "preprocess/partition/polygon_list.h"
#include "preprocess/partition/split_rule.h"

namespace farcell {

// What one thread needs. The limits are fixed: where cells are cut in memory and where on disk decides the order of
// triangles in leaves, and that must depend on the model alone.
struct SplitMemory {
  static constexpr size_t kRecordsBytes = size_t{4} << 20;  // uncut triangles of a cell
  static constexpr size_t kPolygonsBytes = size_t{4}
                                           << 20;  // packed pieces, of all cells from the first to the current
  // Two buffers of records, codes, leaves; the pieces, in vectors that grow; what reading and cutting take besides.
  static constexpr size_t kTotalBytes = size_t{24} << 20;

  static Result<SplitMemory> create();
  PageBuffer records, spare, codes, leaves;
};

// A cell's uncut triangles, in the order of the buckets of `layout`.
struct BucketSlice {
  const BucketLayout* layout;
  std::span<const uint32_t> starts;  // of the cell's buckets and those below it, and one more; in records
  int level;                         // of the cell, from the layout's root
};

class CellSplitter {
 public:
  CellSplitter(int gridBits, const SplitRule& rule, const RecordFormat& format, SplitMemory& memory,
               LeafWriter& leaves);

  // The triangles lie in memory.records. False: the pieces outgrew kPolygonsBytes, and what was written is worth
  // nothing.
  Result<bool> split(const CellKey& key, const BucketSlice& slice, PolygonList polygons);

 private:
  struct Cell;
  Result<bool> split(const Cell& cell, PolygonList polygons);
  Result<bool> splitToOctants(const Cell& cell, PolygonList polygons);
  bool shouldSplit(const Cell& cell, const PolygonList& polygons) const;
  bool cut(const Cell& cell, const PolygonList& polygons, std::array<PolygonList, 8>& octants) const;
  Result<bool> writeLeaf(const Cell& cell, const PolygonList& polygons);
  std::span<const std::byte> recordsOf(const Cell& cell) const;

  const int gridBits_;
  const SplitRule& rule_;
  const RecordFormat format_;
  SplitMemory& memory_;
  LeafWriter& leaves_;
  size_t polygonsBytes_ = 0;  // held by all cells from the first to the current
};

}  // namespace farcell
