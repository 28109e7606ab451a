// Rows of equal size, appended in order and read in any, in as much memory as there is.
#pragma once

#include <bit>
#include <cstring>
#include <functional>
#include <type_traits>

#include "cache/base/check.h"
#include "preprocess/mesh/read_memory.h"

namespace farcell {

class PagedRows {
 public:
  // Fills rows [first, first + out.size() / rowBytes), which lie in a file already.
  using Load = std::function<Result<>(uint64_t first, std::span<std::byte> out)>;

  // Rows to be appended, of at most a page.
  PagedRows(std::shared_ptr<ReadMemory> memory, uint32_t rowBytes);
  // `count` rows that are loaded when they are asked for, again after they had to go.
  static Result<std::unique_ptr<PagedRows>> loaded(std::shared_ptr<ReadMemory> memory, uint32_t rowBytes,
                                                   uint64_t count, Load load);
  PagedRows(const PagedRows&) = delete;  // the memory knows its address
  PagedRows& operator=(const PagedRows&) = delete;
  ~PagedRows();

  uint64_t count() const { return count_; }
  uint32_t rowBytes() const { return rowBytes_; }
  const std::shared_ptr<ReadMemory>& memory() const { return memory_; }

  // rowBytes of them.
  Result<> append(const void* row);
  // Valid until the next call that reads or appends rows of the same memory. REQUIRES: index < count(). After a
  // failure, which the memory keeps, zeros.
  const std::byte* row(uint64_t index) {
    Page& page = pages_[index >> shift_];
    if (page.frame == nullptr) [[unlikely]]
      return fault(index);
    page.wasUsed = true;
    return page.frame + (index & mask_) * rowBytes_;
  }
  // The same, to be changed. After a failure, of no effect.
  std::byte* change(uint64_t index);
  // Has the processor fetch a row that is about to be asked for.
  void prefetch(uint64_t index) const {
    if (index >= count_) return;
    const std::byte* frame = pages_[index >> shift_].frame;
    if (frame != nullptr) __builtin_prefetch(frame + (index & mask_) * rowBytes_);
  }

 private:
  friend ReadMemory;
  static constexpr uint64_t kNoSlot = UINT64_MAX;
  struct Page {
    std::byte* frame = nullptr;  // of the memory; null: not here
    uint64_t slot = kNoSlot;     // in the scratch file, where it has been written
    uint32_t resident = 0;       // where the memory lists it
    bool wasUsed = false;        // since the clock came by
    bool isDirty = false;        // differs from what the slot or the file has
  };
  // With it go places in the memory's lists, which grow by doubling.
  static constexpr uint64_t kBytesPerPage = sizeof(Page) + 2 * (sizeof(ReadMemory::Resident) + sizeof(std::byte*));

  uint64_t frameBytes() const { return (mask_ + 1) * rowBytes_; }  // used of a page
  Result<> reservePages(uint64_t count);
  Result<> bringIn(uint64_t page);
  Result<> fill(uint64_t page);
  Result<> writeOut(uint64_t page);
  const std::byte* fault(uint64_t index);

  const std::shared_ptr<ReadMemory> memory_;
  const uint32_t rowBytes_;
  const uint32_t shift_;  // of a row's index: gives its page
  const uint64_t mask_;
  Load load_;
  uint64_t count_ = 0;
  std::vector<Page> pages_;
  MemoryClaim table_;
  std::vector<std::byte> zeros_;  // a row of them, after a failure
};

// The same, of values of a type.
template <class T>
class PagedArray {
  static_assert(std::is_trivially_copyable_v<T>);

 public:
  explicit PagedArray(std::shared_ptr<ReadMemory> memory)
      : rows_(std::make_unique<PagedRows>(std::move(memory), sizeof(T))) {}

  uint64_t size() const { return rows_->count(); }
  bool empty() const { return size() == 0; }
  Result<> append(const T& value) { return rows_->append(&value); }
  void clear() { rows_ = std::make_unique<PagedRows>(rows_->memory(), sizeof(T)); }
  T operator[](uint64_t index) const {
    T value;
    std::memcpy(&value, rows_->row(index), sizeof(T));
    return value;
  }

 private:
  std::unique_ptr<PagedRows> rows_;
};

}  // namespace farcell
