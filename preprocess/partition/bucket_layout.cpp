#include "preprocess/partition/bucket_layout.h"

#include <numeric>

namespace farcell {
namespace {

// The size is known to the compiler: records are copied one by one.
template <size_t kBytes>
void copyToBuckets(std::span<const std::byte> records, std::span<const uint16_t> codes, uint32_t* next,
                   std::byte* out) {
  const std::byte* record = records.data();
  for (const uint16_t code : codes) {
    std::memcpy(out + kBytes * next[code]++, record, kBytes);
    record += kBytes;
  }
}

using CopyToBuckets = void (*)(std::span<const std::byte>, std::span<const uint16_t>, uint32_t*, std::byte*);
CopyToBuckets copyFor(size_t recordBytes) {
  switch (recordBytes) {
    case 36:
      return copyToBuckets<36>;
    case 48:
      return copyToBuckets<48>;
    case 64:
      return copyToBuckets<64>;
    default:
      return copyToBuckets<76>;
  }
}

}  // namespace

BucketLayout::BucketLayout(const CellKey& root, int gridBits, int depth)
    : depth_(depth), shift_(gridBits - static_cast<int>(root.level) - depth), cells_(uint32_t{1} << depth) {
  const int rootShift = gridBits - static_cast<int>(root.level);
  origin_ = GridPoint(static_cast<int32_t>(root.x << rootShift), static_cast<int32_t>(root.y << rootShift),
                      static_cast<int32_t>(root.z << rootShift));
  subtree_[depth] = 1;
  for (int level = depth - 1; level >= 0; --level) subtree_[level] = 1 + 8 * subtree_[level + 1];
  for (size_t axis = 0; axis < 3; ++axis)
    for (uint32_t cell = 0; cell < cells_; ++cell)
      for (int level = 0; level < depth; ++level)
        if (cell >> (depth - 1 - level) & 1)
          offset_[axis][cell] = static_cast<uint16_t>(offset_[axis][cell] + (subtree_[level + 1] << axis));
}

GridBox sortByBucket(const BucketLayout& layout, const RecordFormat& format, std::span<const std::byte> records,
                     std::byte* out, std::span<uint16_t> codes, std::span<uint32_t> starts) {
  GridBox box;
  std::fill(starts.begin(), starts.end(), 0);
  for (size_t i = 0; i < codes.size(); ++i) {
    const Corners corners = cornersOf(records.data() + i * format.bytes());
    for (const GridPoint& corner : corners) box.include(corner);
    codes[i] = layout.bucketOf(corners);
    ++starts[codes[i] + size_t{1}];
  }
  // Copying moves each bucket's start to its end, which is the start of the next: shifted by one they are right again.
  std::inclusive_scan(starts.begin(), starts.end(), starts.begin());
  copyFor(format.bytes())(records, codes, starts.data(), out);
  std::shift_right(starts.begin(), starts.end(), 1);
  starts[0] = 0;
  return box;
}

}  // namespace farcell
