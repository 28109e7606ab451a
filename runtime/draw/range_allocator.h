// Ranges of a fixed capacity, handed out first fit and taken back: the layout of one GPU buffer.
#pragma once

#include <cstdint>
#include <map>
#include <optional>

namespace farcell {

class RangeAllocator {
 public:
  explicit RangeAllocator(uint32_t capacity);

  uint32_t capacity() const { return capacity_; }
  bool empty() const { return free_.size() == 1 && free_.begin()->second == capacity_; }
  // Offset of `count` consecutive elements (> 0), or nothing when no gap is large enough.
  std::optional<uint32_t> allocate(uint32_t count);
  // REQUIRES: a range that `allocate` returned.
  void release(uint32_t offset, uint32_t count);

 private:
  uint32_t capacity_;
  std::map<uint32_t, uint32_t> free_;  // count by offset; gaps never touch
};

}  // namespace farcell
