// All triangles of a cell in scratch, in the buckets of a BucketLayout, however many there are.
//
// The file is a row of segments: as many triangles as memory holds, sorted into buckets, with a table of where each
// begins. So it is written from end to end whatever the order of the input, and a bucket is read as one piece of each
// segment. Segments carry their checksum and how far into the source they reach: after a crash the builder keeps those
// that are whole and asks for the rest of the source alone.
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <vector>

#include "cache/base/file.h"
#include "preprocess/partition/bucket_layout.h"

namespace farcell {

// A finished file; read from any thread.
class BucketFile {
 public:
  const BucketLayout& layout() const { return layout_; }
  const std::filesystem::path& path() const { return path_; }
  const GridBox& box() const { return box_; }
  // In buckets [first, first + buckets).
  uint64_t triangles(size_t first, size_t buckets) const { return before_[first + buckets] - before_[first]; }
  // The records of these buckets, bucket by bucket, in each as they came. `starts` gets, a bucket and one more, where
  // each begins. REQUIRES: room in `out` for triangles() records.
  Result<> read(size_t first, size_t buckets, std::byte* out, std::vector<uint32_t>& starts) const;
  // The same in portions, of at most portion.size() bytes.
  using Sink = std::function<Result<>(std::span<const std::byte> records)>;
  Result<> forEachPortion(size_t first, size_t buckets, std::span<std::byte> portion, const Sink& sink) const;

 private:
  friend class BucketBuilder;
  struct Segment {
    uint64_t tableOffset;
    uint64_t records;
  };
  BucketFile(std::filesystem::path path, ScratchFile file, const BucketLayout& layout, const RecordFormat& format)
      : path_(std::move(path)), file_(std::move(file)), layout_(layout), format_(format), before_(layout.count() + 1) {}
  size_t tableEntries() const { return layout_.count() + 1; }
  uint64_t recordsOffset(const Segment& segment) const {
    return segment.tableOffset + tableEntries() * sizeof(uint32_t);
  }
  Result<> readTable(const Segment& segment, size_t first, std::span<uint32_t> table) const;

  std::filesystem::path path_;
  ScratchFile file_;
  BucketLayout layout_;
  RecordFormat format_;
  std::vector<Segment> segments_;
  std::vector<uint64_t> before_;  // triangles in lower buckets
  GridBox box_;
};

// Fills a BucketFile. One thread hands in records; sorting and writing are done by `workers` others, or by the same.
class BucketBuilder {
 public:
  struct Limits {
    size_t portionBytes;  // of a segment's records
    int workers = 0;
  };
  // What a builder takes at most.
  static uint64_t memoryBytes(const Limits& limits);

  // Goes on with what an earlier builder left in the file, as far as it is whole.
  static Result<std::unique_ptr<BucketBuilder>> open(const std::filesystem::path& path, const BucketLayout& layout,
                                                     const RecordFormat& format, const Limits& limits);
  ~BucketBuilder();

  bool complete() const;        // nothing is missing: finish at once
  uint64_t sourceDone() const;  // so many triangles of the source need not come again

  // A record goes to slot(), then take() it. flush() when full(), and now and then: what was flushed outlives a crash.
  // sourceEnd: triangles of the source that have been handed in or left out by now.
  bool full() const;
  std::byte* slot();
  void take();
  Result<> flush(uint64_t sourceEnd);
  Result<std::shared_ptr<const BucketFile>> finish(uint64_t sourceEnd);

 private:
  class State;
  explicit BucketBuilder(std::unique_ptr<State> state);
  Result<> begin();
  std::unique_ptr<State> state_;
  // The portion that is being filled:
  std::byte* begin_ = nullptr;
  std::byte* next_ = nullptr;
  std::byte* end_ = nullptr;
  size_t recordBytes_ = 0;
};

inline bool BucketBuilder::full() const { return next_ == end_; }
inline std::byte* BucketBuilder::slot() { return next_; }
inline void BucketBuilder::take() { next_ += recordBytes_; }

}  // namespace farcell
