// Walking the rows of an element that says which vertices make triangles: the same code counts and emits.
#pragma once

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

// The layout nearly every binary file has: rows of nothing but a byte, 3, and three 32-bit indices. Takes as many of
// them as are at the cursor, at most `rows`, and returns their number.
template <class Index, class Source, class Taker>
uint64_t takeTriangleRows(Source& source, uint64_t rows, Taker& taker) {
  constexpr size_t kRowBytes = 1 + 3 * sizeof(Index);
  ByteStream& stream = source.stream();
  if (!stream.need(kRowBytes)) return 0;
  const std::byte* at = stream.cursor();
  const uint64_t here = std::min<uint64_t>(rows, stream.available() / kRowBytes);
  uint64_t row = 0;
  for (; row < here && *at == std::byte{3}; ++row, at += kRowBytes) {
    const auto index = [at](size_t i) {
      return uint64_t(int64_t{loadScalar<Index, Source::kSwap>(at + 1 + i * sizeof(Index))});
    };
    taker.add({index(0), index(1), index(2)});
  }
  stream.advance(static_cast<size_t>(row * kRowBytes));
  return row;
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
