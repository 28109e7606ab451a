#include "preprocess/partition/bucket_file.h"

#include <algorithm>
#include <numeric>

namespace farcell {

Result<> BucketFile::readTable(const Segment& segment, size_t first, std::span<uint32_t> table) const {
  return file_.readAt(segment.tableOffset + first * sizeof(uint32_t), std::as_writable_bytes(table));
}

Result<> BucketFile::read(size_t first, size_t buckets, std::byte* out, std::vector<uint32_t>& starts) const {
  starts.resize(buckets + 1);
  for (size_t i = 0; i <= buckets; ++i) starts[i] = static_cast<uint32_t>(before_[first + i] - before_[first]);
  std::vector<uint32_t> next(starts.begin(), starts.end()), table(buckets + 1);
  const size_t bytes = format_.bytes();
  for (const Segment& segment : segments_) {
    FARCELL_TRY(readTable(segment, first, table));
    for (size_t i = 0; i < buckets; ++i) {
      const uint32_t count = table[i + 1] - table[i];
      if (count == 0) continue;
      FARCELL_TRY(file_.readAt(recordsOffset(segment) + table[i] * bytes, {out + next[i] * bytes, count * bytes}));
      next[i] += count;
    }
  }
  return {};
}

Result<> BucketFile::forEachPortion(size_t first, size_t buckets, std::span<std::byte> portion,
                                    const Sink& sink) const {
  const size_t bytes = format_.bytes(), room = portion.size() / bytes;
  for (size_t bucket = first; bucket < first + buckets; ++bucket) {
    if (triangles(bucket, 1) == 0) continue;
    for (const Segment& segment : segments_) {
      std::array<uint32_t, 2> range;
      FARCELL_TRY(readTable(segment, bucket, range));
      for (uint64_t at = range[0]; at < range[1];) {
        const size_t count = std::min<size_t>(room, range[1] - at);
        const std::span<std::byte> records = portion.first(count * bytes);
        FARCELL_TRY(file_.readAt(recordsOffset(segment) + at * bytes, records));
        FARCELL_TRY(sink(records));
        at += count;
      }
    }
  }
  return {};
}

}  // namespace farcell
