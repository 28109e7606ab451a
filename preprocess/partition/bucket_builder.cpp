#include <algorithm>
#include <condition_variable>
#include <mutex>
#include <numeric>
#include <optional>
#include <thread>

#include "cache/base/hash.h"
#include "preprocess/partition/bucket_file.h"
#include "preprocess/partition/page_buffer.h"

namespace farcell {
namespace {

constexpr uint64_t kMagic = 0x31676573'6c6c6563;  // "cellseg1"

// Before the table and the records of a segment; one without records and `last` ends the file.
struct SegmentHead {
  uint64_t magic = kMagic;
  uint64_t index = 0;
  uint64_t records = 0;
  uint64_t sourceEnd = 0;
  uint64_t last = 0;
  GridBox box;
  uint64_t bodyHash = 0;  // of table and records
  uint64_t headHash = 0;  // of what stands before it
};

uint64_t headHash(const SegmentHead& head) {
  return hashBytes(std::as_bytes(std::span(&head, 1)).first(offsetof(SegmentHead, headHash)));
}

// Records that wait to be sorted, or that are.
struct Portion {
  PageBuffer records;
  size_t count = 0;
  uint64_t segment = 0;
  uint64_t headOffset = 0;
  uint64_t sourceEnd = 0;
};

// What a worker needs besides.
struct SortMemory {
  PageBuffer sorted;
  PageBuffer codes;
  std::vector<std::byte> head;  // SegmentHead, then the table
};

}  // namespace

class BucketBuilder::State {
 public:
  State(BucketFile file, const Limits& limits) : file_(std::move(file)), limits_(limits) {}

  ~State() { stop(); }

  // Keeps the segments that are whole.
  Result<> resume() {
    FARCELL_ASSIGN(const uint64_t size, file_.file_.sizeBytes());
    while (!complete_) {
      FARCELL_ASSIGN(const bool whole, keepSegment(size));
      if (!whole) break;
    }
    if (!complete_ && size > endBytes_) return file_.file_.truncate(endBytes_);
    return {};
  }

  // Buffers and workers: not needed where nothing is missing.
  Result<> start() {
    const int workers = limits_.workers;
    sortMemory_.resize(static_cast<size_t>(std::max(1, workers)));
    for (SortMemory& memory : sortMemory_) {
      FARCELL_ASSIGN(memory.sorted, PageBuffer::create(capacity() * file_.format_.bytes()));
      FARCELL_ASSIGN(memory.codes, PageBuffer::create(capacity() * sizeof(uint16_t)));
      memory.head.resize(headBytes());
    }
    for (int i = 0; i <= workers; ++i) {
      Portion portion;
      FARCELL_ASSIGN(portion.records, PageBuffer::create(capacity() * file_.format_.bytes()));
      free_.push_back(std::move(portion));
    }
    for (int i = 0; i < workers; ++i) threads_.emplace_back([this, i] { work(sortMemory_[static_cast<size_t>(i)]); });
    return {};
  }

  // An empty portion. Waits for one.
  Result<std::byte*> take() {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [&] { return error_ || !free_.empty(); });
    if (error_) return tl::unexpected<Error>(*error_);
    filling_ = std::move(free_.back());
    free_.pop_back();
    return filling_.records.data();
  }

  // Hands the portion that take() gave to a worker.
  Result<> give(size_t count, uint64_t sourceEnd) {
    filling_.count = count;
    filling_.sourceEnd = sourceEnd;
    filling_.segment = segments_++;
    filling_.headOffset = endBytes_;
    endBytes_ += headBytes() + count * file_.format_.bytes();
    if (threads_.empty()) {
      FARCELL_TRY(writeSegment(filling_, sortMemory_[0]));
      free_.push_back(std::move(filling_));
      return {};
    }
    const std::lock_guard lock(mutex_);
    full_.push_back(std::move(filling_));
    changed_.notify_all();
    return {};
  }

  Result<BucketFile> finish(uint64_t sourceEnd) {
    stop();
    if (error_) return tl::unexpected<Error>(*error_);
    if (!complete_) {
      SegmentHead head;
      head.index = segments_;
      head.sourceEnd = sourceEnd;
      head.last = 1;
      head.headHash = headHash(head);
      FARCELL_TRY(file_.file_.writeAt(endBytes_, std::as_bytes(std::span(&head, 1))));
    }
    std::inclusive_scan(file_.before_.begin(), file_.before_.end(), file_.before_.begin());
    return std::move(file_);
  }

  bool complete() const { return complete_; }
  uint64_t sourceDone() const { return sourceDone_; }
  size_t capacity() const { return std::max<size_t>(1, limits_.portionBytes / file_.format_.bytes()); }
  size_t recordBytes() const { return file_.format_.bytes(); }

 private:
  size_t headBytes() const { return sizeof(SegmentHead) + file_.tableEntries() * sizeof(uint32_t); }

  void work(SortMemory& memory) {
    std::unique_lock lock(mutex_);
    while (true) {
      changed_.wait(lock, [&] { return stopping_ || !full_.empty(); });
      if (full_.empty()) return;
      Portion portion = std::move(full_.front());
      full_.erase(full_.begin());
      lock.unlock();
      const Result<> written = writeSegment(portion, memory);
      lock.lock();
      if (!written && !error_) error_ = written.error();
      free_.push_back(std::move(portion));
      changed_.notify_all();
    }
  }

  // Ends the workers once all is written.
  void stop() {
    {
      const std::lock_guard lock(mutex_);
      stopping_ = true;
      changed_.notify_all();
    }
    threads_.clear();
  }

  Result<> writeSegment(const Portion& portion, SortMemory& memory) {
    const std::span<uint32_t> table(reinterpret_cast<uint32_t*>(memory.head.data() + sizeof(SegmentHead)),
                                    file_.tableEntries());
    const std::span<uint16_t> codes(reinterpret_cast<uint16_t*>(memory.codes.data()), portion.count);
    const std::span<const std::byte> sorted(memory.sorted.data(), portion.count * recordBytes());
    SegmentHead head;
    head.index = portion.segment;
    head.records = portion.count;
    head.sourceEnd = portion.sourceEnd;
    head.box = sortByBucket(file_.layout_, file_.format_, {portion.records.data(), sorted.size()}, memory.sorted.data(),
                            codes, table);
    Hasher hasher;
    hasher.add(std::as_bytes(table));
    hasher.add(sorted);
    head.bodyHash = hasher.value();
    head.headHash = headHash(head);
    std::memcpy(memory.head.data(), &head, sizeof(head));
    FARCELL_TRY(file_.file_.writeAt(portion.headOffset, memory.head));
    FARCELL_TRY(file_.file_.writeAt(portion.headOffset + memory.head.size(), sorted));
    const std::lock_guard lock(mutex_);
    addSegment(head, portion.headOffset, table);
    return {};
  }

  void addSegment(const SegmentHead& head, uint64_t headOffset, std::span<const uint32_t> table) {
    // In the order of the source, whichever is written first.
    file_.segments_.resize(std::max<size_t>(file_.segments_.size(), head.index + 1));
    file_.segments_[head.index] = {headOffset + sizeof(head), head.records};
    file_.box_.include(head.box);
    for (size_t bucket = 0; bucket + 1 < table.size(); ++bucket)
      file_.before_[bucket + 1] += table[bucket + 1] - table[bucket];
  }

  // Of the segment at the end: whether it is whole, and then it is kept.
  Result<bool> keepSegment(uint64_t fileBytes) {
    SegmentHead head;
    const uint64_t room = fileBytes - std::min(endBytes_, fileBytes);
    if (room < sizeof(head)) return false;
    FARCELL_TRY(file_.file_.readAt(endBytes_, std::as_writable_bytes(std::span(&head, 1))));
    if (head.magic != kMagic || head.headHash != headHash(head) || head.index != segments_) return false;
    if (head.last == 0) {
      if (room < headBytes() || head.records > (room - headBytes()) / recordBytes()) return false;
      std::vector<uint32_t> table(file_.tableEntries());
      const uint64_t recordsOffset = endBytes_ + headBytes(), recordsBytes = head.records * recordBytes();
      FARCELL_TRY(file_.readTable({endBytes_ + sizeof(head), head.records}, 0, table));
      FARCELL_ASSIGN(const uint64_t hash, bodyHash(table, recordsOffset, recordsBytes));
      if (hash != head.bodyHash) return false;
      addSegment(head, endBytes_, table);
      endBytes_ = recordsOffset + recordsBytes;
      ++segments_;
    }
    complete_ = head.last != 0;
    sourceDone_ = head.sourceEnd;
    return true;
  }

  Result<uint64_t> bodyHash(std::span<const uint32_t> table, uint64_t offset, uint64_t bytes) const {
    Hasher hasher;
    hasher.add(std::as_bytes(table));
    std::vector<std::byte> buffer(size_t{1} << 18);
    for (uint64_t at = 0; at < bytes; at += buffer.size()) {
      const std::span<std::byte> part = std::span(buffer).first(std::min<uint64_t>(buffer.size(), bytes - at));
      FARCELL_TRY(file_.file_.readAt(offset + at, part));
      hasher.add(part);
    }
    return hasher.value();
  }

  BucketFile file_;
  const Limits limits_;
  Portion filling_;
  uint64_t segments_ = 0;
  uint64_t endBytes_ = 0;
  uint64_t sourceDone_ = 0;
  bool complete_ = false;
  std::vector<SortMemory> sortMemory_;
  std::mutex mutex_;
  // Guarded by mutex_ while workers run; file_ too:
  std::condition_variable changed_;
  std::vector<Portion> free_, full_;
  bool stopping_ = false;
  std::optional<Error> error_;
  std::vector<std::jthread> threads_;
};

uint64_t BucketBuilder::memoryBytes(const Limits& limits) {
  // Tables of 37,449 entries; codes are two bytes for each record of 36 or more.
  const auto workers = static_cast<uint64_t>(std::max(0, limits.workers)), sorters = std::max<uint64_t>(1, workers);
  return (workers + 1) * limits.portionBytes + sorters * (limits.portionBytes + limits.portionBytes / 18 + (1 << 18)) +
         (1 << 20);
}

BucketBuilder::BucketBuilder(std::unique_ptr<State> state)
    : state_(std::move(state)), recordBytes_(state_->recordBytes()) {}

BucketBuilder::~BucketBuilder() = default;

Result<std::unique_ptr<BucketBuilder>> BucketBuilder::open(const std::filesystem::path& path,
                                                           const BucketLayout& layout, const RecordFormat& format,
                                                           const Limits& limits) {
  FARCELL_ASSIGN(ScratchFile file, ScratchFile::open(path));
  auto state = std::make_unique<State>(BucketFile(path, std::move(file), layout, format), limits);
  FARCELL_TRY(state->resume());
  if (!state->complete()) FARCELL_TRY(state->start());
  std::unique_ptr<BucketBuilder> builder(new BucketBuilder(std::move(state)));
  if (!builder->complete()) FARCELL_TRY(builder->begin());
  return builder;
}

bool BucketBuilder::complete() const { return state_->complete(); }
uint64_t BucketBuilder::sourceDone() const { return state_->sourceDone(); }

Result<> BucketBuilder::begin() {
  FARCELL_ASSIGN(next_, state_->take());
  begin_ = next_;
  end_ = next_ + state_->capacity() * recordBytes_;
  return {};
}

Result<> BucketBuilder::flush(uint64_t sourceEnd) {
  if (next_ == begin_) return {};
  FARCELL_TRY(state_->give(static_cast<size_t>(next_ - begin_) / recordBytes_, sourceEnd));
  return begin();
}

Result<std::shared_ptr<const BucketFile>> BucketBuilder::finish(uint64_t sourceEnd) {
  if (!complete()) FARCELL_TRY(flush(sourceEnd));
  FARCELL_ASSIGN(BucketFile file, state_->finish(sourceEnd));
  return std::make_shared<const BucketFile>(std::move(file));
}

}  // namespace farcell
