// The memory that opened meshes share: a ceiling on all that grows with their files.
//
// 1. Rows (paged_rows.h) live in pages, which are here while there is room: a clock throws out those not asked for
//    since it came by, into one scratch file unless they can be read again from where they came from.
// 2. What cannot be paged - tables, what a library decodes whole - is a MemoryClaim, made before its bytes are, which
//    pages give way to; exhausted when they are not enough.
// What does not grow with a file is not counted: each pass has buffers of less than 1 MiB, and a line of text, with the
// numbers of its polygon, takes what it takes (text_lines.h has its limit).
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "cache/base/file.h"
#include "preprocess/mesh/page_arena.h"

namespace farcell {

// The triangles of a mesh, their order and their bits are the same whatever these are.
struct ReadOptions {
  uint64_t memoryBytes = uint64_t{512} << 20;  // of all files opened together; at least kLeastReadMemoryBytes
  std::filesystem::path scratchDirectory;      // used when memory is not enough; empty: that of the system
};
inline constexpr uint64_t kLeastReadMemoryBytes = uint64_t{64} << 10;

class PagedRows;
class ReadMemory;

// Bytes taken off the memory until the claim goes.
class MemoryClaim {
 public:
  MemoryClaim() = default;
  MemoryClaim(MemoryClaim&& other) noexcept;
  MemoryClaim& operator=(MemoryClaim&& other) noexcept;
  ~MemoryClaim();

  uint64_t sizeBytes() const { return bytes_; }
  void shrink(uint64_t bytes);  // to `bytes`, of which there are at least as many
  void add(MemoryClaim other);  // of the same memory

 private:
  friend ReadMemory;
  MemoryClaim(std::shared_ptr<ReadMemory> memory, uint64_t bytes) : memory_(std::move(memory)), bytes_(bytes) {}

  std::shared_ptr<ReadMemory> memory_;
  uint64_t bytes_ = 0;
};

// For one thread at a time.
class ReadMemory : public std::enable_shared_from_this<ReadMemory> {
 public:
  // invalidArgument below the least.
  static Result<std::shared_ptr<ReadMemory>> create(const ReadOptions& options);

  // `what`, for the message: "city.gltf: its JSON".
  Result<MemoryClaim> claim(uint64_t bytes, const std::string& what);

  uint64_t pageBytes() const { return pageBytes_; }
  uint64_t usedBytes() const { return usedBytes_; }
  uint64_t peakBytes() const { return peakBytes_; }
  uint64_t spilledBytes() const { return scratchBytes_; }  // length of the scratch file
  // Why what rows gave since is worth nothing.
  const std::optional<Error>& failure() const { return failure_; }

 private:
  friend MemoryClaim;
  friend PagedRows;
  struct Resident {
    PagedRows* owner;
    uint64_t page;
  };

  ReadMemory(const ReadOptions& options, uint64_t pageBytes, PageArena arena);
  Result<> makeRoom(uint64_t bytes);
  Result<std::byte*> takePage(PagedRows& owner, uint64_t page);
  Result<> evict(size_t resident);
  void forget(size_t resident);  // makes its place free
  Result<uint64_t> takeSlot();
  void giveSlot(uint64_t offset);
  void take(uint64_t bytes);

  const uint64_t limitBytes_;
  const uint64_t pageBytes_;
  const std::filesystem::path scratchDirectory_;
  PageArena arena_;
  uint64_t usedBytes_ = 0;
  uint64_t peakBytes_ = 0;
  std::vector<Resident> residents_;
  size_t hand_ = 0;
  std::optional<ScratchFile> scratch_;
  uint64_t scratchBytes_ = 0;
  std::vector<uint64_t> freeSlots_;  // of a page each
  std::optional<Error> failure_;
};

}  // namespace farcell
