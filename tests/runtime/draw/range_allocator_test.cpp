#include "runtime/draw/range_allocator.h"

#include <gtest/gtest.h>

#include <fmt/format.h>
#include <random>
#include <vector>

namespace farcell {
namespace {

TEST(RangeAllocator, rangesNeverOverlapAndAllComeBack) {
  const unsigned seed = 3;
  SCOPED_TRACE(fmt::format("seed {}", seed));
  std::mt19937 random(seed);
  constexpr uint32_t kCapacity = 1000;
  RangeAllocator allocator(kCapacity);
  std::vector<int> owner(kCapacity, -1);
  std::vector<std::pair<uint32_t, uint32_t>> ranges;
  for (int i = 0; i < 5000; ++i) {
    if (random() % 2 == 0 || ranges.empty()) {
      const uint32_t count = 1 + static_cast<uint32_t>(random() % 80);
      const auto offset = allocator.allocate(count);
      // First fit: a refusal means that no free run is long enough.
      uint32_t run = 0, longest = 0;
      for (const int o : owner) longest = std::max(longest, run = o < 0 ? run + 1 : 0);
      ASSERT_EQ(offset.has_value(), longest >= count);
      if (!offset) continue;
      for (uint32_t k = 0; k < count; ++k) {
        ASSERT_LT(owner.at(*offset + k), 0);
        owner[*offset + k] = i;
      }
      ranges.emplace_back(*offset, count);
    } else {
      const size_t chosen = random() % ranges.size();
      const auto [offset, count] = ranges[chosen];
      ranges.erase(ranges.begin() + static_cast<ptrdiff_t>(chosen));
      allocator.release(offset, count);
      for (uint32_t k = 0; k < count; ++k) owner[offset + k] = -1;
    }
    ASSERT_EQ(allocator.empty(), ranges.empty());
  }
  for (const auto& [offset, count] : ranges) allocator.release(offset, count);
  EXPECT_TRUE(allocator.empty());
  EXPECT_EQ(allocator.allocate(kCapacity), 0u);
  EXPECT_FALSE(allocator.allocate(1));
}

}  // namespace
}  // namespace farcell
