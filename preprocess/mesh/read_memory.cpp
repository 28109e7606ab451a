#include "preprocess/mesh/read_memory.h"

#include <algorithm>
#include <bit>
#include <system_error>
#include <utility>

#include "preprocess/mesh/paged_rows.h"

namespace farcell {
namespace {

// Small enough for random order, large enough for an orderly one to notice nothing.
constexpr uint64_t kMaxPageBytes = uint64_t{16} << 10;
constexpr uint64_t kLeastPages = 32;

Result<ScratchFile> createScratch(const std::filesystem::path& directory) {
  if (!directory.empty()) return ScratchFile::create(directory);
  std::error_code code;
  const std::filesystem::path system = std::filesystem::temp_directory_path(code);
  if (code) return fail(ErrorKind::io, "expected a directory for temporary files, found: {}", code.message());
  return ScratchFile::create(system);
}

}  // namespace

MemoryClaim::MemoryClaim(MemoryClaim&& other) noexcept
    : memory_(std::move(other.memory_)), bytes_(std::exchange(other.bytes_, 0)) {}

MemoryClaim& MemoryClaim::operator=(MemoryClaim&& other) noexcept {
  std::swap(memory_, other.memory_);
  std::swap(bytes_, other.bytes_);
  return *this;
}

MemoryClaim::~MemoryClaim() { shrink(0); }

void MemoryClaim::shrink(uint64_t bytes) {
  FARCELL_CHECK(bytes <= bytes_);
  if (memory_) memory_->usedBytes_ -= bytes_ - bytes;
  bytes_ = bytes;
}

void MemoryClaim::add(MemoryClaim other) {
  if (!memory_) memory_ = other.memory_;
  FARCELL_CHECK(memory_ == other.memory_ || other.bytes_ == 0);
  bytes_ += std::exchange(other.bytes_, 0);
}

ReadMemory::ReadMemory(const ReadOptions& options, uint64_t pageBytes, PageArena arena)
    : limitBytes_(options.memoryBytes),
      pageBytes_(pageBytes),
      scratchDirectory_(options.scratchDirectory),
      arena_(std::move(arena)) {}

Result<std::shared_ptr<ReadMemory>> ReadMemory::create(const ReadOptions& options) {
  if (options.memoryBytes < kLeastReadMemoryBytes)
    return fail(ErrorKind::invalidArgument, "expected at least {} bytes of memory to read meshes in, found {}",
                kLeastReadMemoryBytes, options.memoryBytes);
  const uint64_t pageBytes = std::min(kMaxPageBytes, std::bit_floor(options.memoryBytes / kLeastPages));
  FARCELL_ASSIGN(PageArena arena, PageArena::create(options.memoryBytes, pageBytes));
  return std::shared_ptr<ReadMemory>(new ReadMemory(options, pageBytes, std::move(arena)));
}

Result<MemoryClaim> ReadMemory::claim(uint64_t bytes, const std::string& what) {
  if (bytes > limitBytes_ || !makeRoom(bytes)) {
    if (failure_) return tl::unexpected<Error>(*failure_);
    return fail(ErrorKind::exhausted,
                "{}: expected to fit the memory for reading meshes, of {} bytes, found {} bytes beside {} others", what,
                limitBytes_, bytes, usedBytes_);
  }
  take(bytes);
  arena_.trim();
  return MemoryClaim(shared_from_this(), bytes);
}

void ReadMemory::take(uint64_t bytes) {
  usedBytes_ += bytes;
  peakBytes_ = std::max(peakBytes_, usedBytes_);
}

Result<> ReadMemory::makeRoom(uint64_t bytes) {
  while (bytes > limitBytes_ - usedBytes_) {
    if (residents_.empty())
      return fail(ErrorKind::exhausted, "expected {} bytes of memory to read meshes in, found {} of {} left", bytes,
                  limitBytes_ - usedBytes_, limitBytes_);
    if (hand_ >= residents_.size()) hand_ = 0;
    PagedRows::Page& page = residents_[hand_].owner->pages_[residents_[hand_].page];
    if (std::exchange(page.wasUsed, false)) {
      ++hand_;
      continue;
    }
    if (Result<> evicted = evict(hand_); !evicted) {
      failure_ = evicted.error();
      return evicted;
    }
  }
  return {};
}

Result<std::byte*> ReadMemory::takePage(PagedRows& owner, uint64_t page) {
  FARCELL_TRY(makeRoom(pageBytes_));
  take(pageBytes_);
  residents_.push_back({&owner, page});
  return arena_.take();
}

Result<> ReadMemory::evict(size_t resident) {
  const Resident gone = residents_[resident];
  FARCELL_TRY(gone.owner->writeOut(gone.page));
  forget(resident);
  return {};
}

void ReadMemory::forget(size_t resident) {
  const Resident gone = residents_[resident];
  PagedRows::Page& page = gone.owner->pages_[gone.page];
  arena_.give(std::exchange(page.frame, nullptr));
  usedBytes_ -= pageBytes_;
  residents_[resident] = residents_.back();
  residents_[resident].owner->pages_[residents_[resident].page].resident = static_cast<uint32_t>(resident);
  residents_.pop_back();
}

Result<uint64_t> ReadMemory::takeSlot() {
  if (!freeSlots_.empty()) {
    const uint64_t offset = freeSlots_.back();
    freeSlots_.pop_back();
    usedBytes_ -= sizeof(uint64_t);
    return offset;
  }
  if (!scratch_) {
    FARCELL_ASSIGN(scratch_, createScratch(scratchDirectory_));
  }
  return std::exchange(scratchBytes_, scratchBytes_ + pageBytes_);
}

void ReadMemory::giveSlot(uint64_t offset) {
  freeSlots_.push_back(offset);
  take(sizeof(uint64_t));  // less than its page's place in the table, which has just been freed
}

}  // namespace farcell
