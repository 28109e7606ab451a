// Walking the rows of an element that says which vertices make triangles: the same code counts and emits.
#pragma once

#include <algorithm>
#include <limits>
#include <string>

#include "preprocess/mesh/triangle_batch.h"
#include "preprocess/read/ply/ply_source.h"

namespace farcell {

// Visitors below hand triangles to a Taker: a TriangleBatch, or this.
struct TriangleCounter {
  uint64_t count = 0;
  void add(const TriangleBatch::Indices&) { ++count; }
  bool failed() const { return false; }
};

// A row is a polygon of n corners: n - 2 triangles around its first one (right for convex polygons; a concave one
// is covered as a whole, but may be left by triangles that overlap).
template <class Taker>
struct FanVisitor {
  Taker& taker;
  uint64_t length = 0;
  int64_t first = 0;
  int64_t last = 0;

  void begin() { length = 0; }
  void index(int64_t value) {
    if (length == 0) first = value;
    if (length >= 2) taker.add({uint64_t(first), uint64_t(last), uint64_t(value)});
    last = value;
    ++length;
  }
};

// A row is any number of strips, with -1 between them: each three indices in a row are a triangle, every other one
// turned round, so that all of a strip face the same way.
template <class Taker>
struct StripVisitor {
  Taker& taker;
  uint64_t length = 0;
  int64_t older = 0;
  int64_t last = 0;

  void begin() { length = 0; }
  void index(int64_t value) {
    // Unsigned indices cannot say -1, but their writers do.
    const bool restart = value == -1 || value == std::numeric_limits<uint32_t>::max();
    if (restart) {
      length = 0;
      return;
    }
    if (length >= 2 && length % 2 == 0) taker.add({uint64_t(older), uint64_t(last), uint64_t(value)});
    if (length >= 2 && length % 2 == 1) taker.add({uint64_t(last), uint64_t(older), uint64_t(value)});
    older = last;
    last = value;
    ++length;
  }
};

template <class Source>
bool listCount(Source& source, const PlyProperty& list, int64_t& count) {
  if (!source.integer(*list.countType, count)) return false;
  if (count >= 0 && source.holds(list.type, uint64_t(count))) return true;
  return source.rejectCount(count);
}

template <class Source>
bool skipProperty(Source& source, const PlyProperty& property) {
  int64_t count = 1;
  if (property.countType && !listCount(source, property, count)) return false;
  return source.skip(property.type, uint64_t(count));
}

template <class Source, class Visitor>
bool visitList(Source& source, const PlyProperty& list, Visitor& visitor) {
  int64_t count = 0;
  if (!listCount(source, list, count)) return false;
  // The length says how many triangles a polygon is; what a text has for indices must be looked at all the same.
  if constexpr (!Source::kText && std::is_same_v<Visitor, FanVisitor<TriangleCounter>>) {
    visitor.taker.count += uint64_t(std::max<int64_t>(count - 2, 0));
    return source.skip(list.type, uint64_t(count));
  }
  visitor.begin();
  for (int64_t i = 0, value = 0; i < count; ++i) {
    if (!source.integer(list.type, value)) return false;
    visitor.index(value);
  }
  return true;
}

template <class Source, class Visitor>
bool visitRow(Source& source, const PlyElement& element, size_t list, Visitor& visitor) {
  for (size_t i = 0; i < element.properties.size(); ++i) {
    const PlyProperty& property = element.properties[i];
    if (i == list ? !visitList(source, property, visitor) : !skipProperty(source, property)) return false;
  }
  return true;
}

// The layout nearly every binary file has: rows of nothing but a byte, 3, and three 32-bit indices.
template <class Index, class Source>
struct TriangleRow {
  static constexpr size_t kBytes = 1 + 3 * sizeof(Index);
  const std::byte* at;

  bool isTriangle() const { return *at == std::byte{3}; }
  TriangleBatch::Indices corners() const { return {index(0), index(1), index(2)}; }
  uint64_t index(size_t i) const {
    return uint64_t(int64_t{loadScalar<Index, Source::kSwap>(at + 1 + i * sizeof(Index))});
  }
};

// The first of `rows` rows that are all triangles: their number, which the counter is told.
template <class Row>
uint64_t takeRows(const std::byte* at, uint64_t rows, TriangleCounter& counter) {
  uint64_t row = 0;
  while (row < rows && Row{at + row * Row::kBytes}.isTriangle()) ++row;
  counter.count += row;
  return row;
}

template <class Row>
uint64_t takeRows(const std::byte* at, uint64_t rows, TriangleBatch& batch) {
  constexpr uint64_t kAhead = 12;  // rows for memory to answer in
  uint64_t row = 0;
  for (; row < rows && Row{at}.isTriangle(); ++row, at += Row::kBytes) {
    if (row + kAhead < rows) batch.prefetch(Row{at + kAhead * Row::kBytes}.corners());
    batch.add(Row{at}.corners());
  }
  return row;
}

// As many such rows as are at the cursor, at most `rows`; their number.
template <class Index, class Source, class Taker>
uint64_t takeTriangleRows(Source& source, uint64_t rows, Taker& taker) {
  using Row = TriangleRow<Index, Source>;
  ByteStream& stream = source.stream();
  if (!stream.need(Row::kBytes)) return 0;
  const uint64_t here = std::min<uint64_t>(rows, stream.available() / Row::kBytes);
  const uint64_t taken = takeRows<Row>(stream.cursor(), here, taker);
  stream.advance(static_cast<size_t>(taken * Row::kBytes));
  return taken;
}

inline bool isCommonLayout(const PlyElement& element) {
  if (element.properties.size() != 1) return false;
  const PlyProperty& list = element.properties[0];
  return list.countType == PlyType::uint8 && (list.type == PlyType::int32 || list.type == PlyType::uint32);
}

// All rows of `element`, whose property `list` holds the indices. The row that could not be read, or the number of
// rows; less also where the taker failed.
template <template <class> class Visitor, class Source, class Taker>
uint64_t visitRows(Source& source, const PlyElement& element, size_t list, Taker& taker) {
  Visitor<Taker> visitor{taker};
  constexpr bool kFan = std::is_same_v<Visitor<Taker>, FanVisitor<Taker>>;
  const bool common = kFan && !Source::kText && isCommonLayout(element);
  const bool isSigned = element.properties[list].type == PlyType::int32;
  uint64_t row = 0;
  while (row < element.count && !taker.failed()) {
    if constexpr (kFan && !Source::kText) {
      const uint64_t left = element.count - row;
      const uint64_t taken = !common    ? 0
                             : isSigned ? takeTriangleRows<int32_t>(source, left, taker)
                                        : takeTriangleRows<uint32_t>(source, left, taker);
      row += taken;
      if (taken > 0) continue;
    }
    if (!visitRow(source, element, list, visitor)) return row;
    ++row;
  }
  return row;
}

}  // namespace farcell
