#include "runtime/draw/range_allocator.h"

#include <algorithm>
#include <iterator>

#include "cache/base/check.h"

namespace farcell {

RangeAllocator::RangeAllocator(uint32_t capacity) : capacity_(capacity) {
  FARCELL_CHECK(capacity > 0);
  free_[0] = capacity;
}

std::optional<uint32_t> RangeAllocator::allocate(uint32_t count) {
  const auto gap = std::find_if(free_.begin(), free_.end(), [&](const auto& entry) { return entry.second >= count; });
  if (count == 0 || gap == free_.end()) return std::nullopt;
  const auto [offset, length] = *gap;
  free_.erase(gap);
  if (length > count) free_[offset + count] = length - count;
  return offset;
}

void RangeAllocator::release(uint32_t offset, uint32_t count) {
  auto next = free_.lower_bound(offset);
  FARCELL_CHECK(next == free_.end() || offset + count <= next->first);
  if (next != free_.end() && offset + count == next->first) {
    count += next->second;
    next = free_.erase(next);
  }
  if (next != free_.begin()) {
    const auto previous = std::prev(next);
    FARCELL_CHECK(previous->first + previous->second <= offset);
    if (previous->first + previous->second == offset) {
      previous->second += count;
      return;
    }
  }
  free_[offset] = count;
}

}  // namespace farcell
