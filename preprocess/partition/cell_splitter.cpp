#include "preprocess/partition/cell_splitter.h"

#include <algorithm>

namespace farcell {
namespace {

// So many levels are sorted at a time: one copy of each triangle instead of three.
constexpr int kDepth = 3;

}  // namespace

// A cell's triangles stand in `records`, at the same place in `spare` there is room for them in another order.
struct CellSplitter::Cell {
  CellKey key;
  std::byte* records;
  std::byte* spare;
  BucketSlice slice;

  size_t ownCount() const { return slice.starts[1] - slice.starts[0]; }  // those that its planes cut
  size_t count() const { return slice.starts.back() - slice.starts.front(); }
};

Result<SplitMemory> SplitMemory::create() {
  SplitMemory memory;
  FARCELL_ASSIGN(memory.records, PageBuffer::create(kRecordsBytes));
  FARCELL_ASSIGN(memory.spare, PageBuffer::create(kRecordsBytes));
  FARCELL_ASSIGN(memory.codes, PageBuffer::create(kRecordsBytes / kCornersBytes * sizeof(uint16_t)));
  FARCELL_ASSIGN(memory.leaves, PageBuffer::create(LeafWriter::kBufferBytes));
  return memory;
}

CellSplitter::CellSplitter(int gridBits, const SplitRule& rule, const RecordFormat& format, SplitMemory& memory,
                           LeafWriter& leaves)
    : gridBits_(gridBits), rule_(rule), format_(format), memory_(memory), leaves_(leaves) {}

Result<bool> CellSplitter::split(const CellKey& key, const BucketSlice& slice, PolygonList polygons) {
  polygonsBytes_ = polygons.bytes();
  return split(Cell{key, memory_.records.data(), memory_.spare.data(), slice}, std::move(polygons));
}

Result<bool> CellSplitter::split(const Cell& cell, PolygonList polygons) {
  if (cell.count() == 0 && polygons.count() == 0) return true;
  if (!shouldSplit(cell, polygons)) return writeLeaf(cell, polygons);
  if (cell.slice.level < cell.slice.layout->depth()) return splitToOctants(cell, std::move(polygons));
  const int depth = std::min(kDepth, rule_.deepest() - static_cast<int>(cell.key.level));
  const BucketLayout layout(cell.key, gridBits_, depth);
  std::vector<uint32_t> starts(layout.count() + 1);
  const size_t offset = cell.slice.starts[0] * format_.bytes();
  const std::span<uint16_t> codes(reinterpret_cast<uint16_t*>(memory_.codes.data()), cell.count());
  sortByBucket(layout, format_, recordsOf(cell), cell.spare + offset, codes, starts);
  return splitToOctants(Cell{cell.key, cell.spare + offset, cell.records + offset, {&layout, starts, 0}},
                        std::move(polygons));
}

Result<bool> CellSplitter::splitToOctants(const Cell& cell, PolygonList polygons) {
  std::array<PolygonList, 8> octants;
  if (!cut(cell, polygons, octants)) return false;
  size_t pieces = cell.count() - cell.ownCount(), bytes = 0;
  for (const PolygonList& octant : octants) {
    pieces += octant.count();
    bytes += octant.bytes();
  }
  if (rule_.multiplies(cell.count() + polygons.count(), pieces)) return writeLeaf(cell, polygons);
  polygonsBytes_ += bytes - polygons.bytes();
  polygons = {};
  const BucketLayout& layout = *cell.slice.layout;
  const int level = cell.slice.level;
  for (size_t octant = 0; octant < 8; ++octant) {
    const auto starts = cell.slice.starts.subspan(layout.child(0, level, octant), layout.subtree(level + 1) + 1);
    const CellKey key = cell.key.child(static_cast<uint32_t>(octant));
    FARCELL_ASSIGN(const bool done, split(Cell{key, cell.records, cell.spare, {&layout, starts, level + 1}},
                                          std::move(octants[octant])));
    if (!done) return false;
  }
  return true;
}

bool CellSplitter::shouldSplit(const Cell& cell, const PolygonList& polygons) const {
  const size_t triangles = cell.count() + polygons.triangles();
  const SplitRule::Choice choice = rule_.choice(cell.key.level, triangles);
  if (choice != SplitRule::Choice::byArea) return choice == SplitRule::Choice::split;
  double area = 0;
  const std::span<const std::byte> records = recordsOf(cell);
  for (size_t at = 0; at < records.size(); at += format_.bytes()) area += areaOf(cornersOf(records.data() + at));
  polygons.forEach([&](const GridPolygon& polygon) { area += areaOf(polygon); });
  return rule_.finerThanTexels(cell.key.level, triangles, area);
}

// False when the pieces outgrow the memory for them.
bool CellSplitter::cut(const Cell& cell, const PolygonList& polygons, std::array<PolygonList, 8>& octants) const {
  const GridPoint middle = middleOf(gridBits_, cell.key);
  OctantPolygons parts;
  size_t bytes = polygonsBytes_;
  const auto put = [&](const GridPolygon& polygon) {
    if (bytes > SplitMemory::kPolygonsBytes) return;
    cutToOctants(polygon, middle, parts);
    for (size_t octant = 0; octant < 8; ++octant) {
      if (parts[octant].count == 0) continue;
      octants[octant].add(parts[octant]);
      bytes += packedBytes(parts[octant]);
    }
  };
  const std::byte* record = recordsOf(cell).data();
  for (size_t i = 0; i < cell.ownCount(); ++i, record += format_.bytes())
    put(polygonOf(format_.triangle(record), format_.texture(record)));
  polygons.forEach(put);
  return bytes <= SplitMemory::kPolygonsBytes;
}

Result<bool> CellSplitter::writeLeaf(const Cell& cell, const PolygonList& polygons) {
  FARCELL_TRY(leaves_.begin(cell.key, cell.count() + polygons.triangles()));
  FARCELL_TRY(leaves_.add(recordsOf(cell)));
  Result<> added;
  polygons.forEach([&](const GridPolygon& polygon) {
    if (added) added = leaves_.add(polygon);
  });
  FARCELL_TRY(std::move(added));
  FARCELL_TRY(leaves_.end());
  polygonsBytes_ -= polygons.bytes();
  return true;
}

std::span<const std::byte> CellSplitter::recordsOf(const Cell& cell) const {
  return {cell.records + cell.slice.starts[0] * format_.bytes(), cell.count() * format_.bytes()};
}

}  // namespace farcell
