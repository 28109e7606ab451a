#include "preprocess/mesh/paged_rows.h"

#include <gtest/gtest.h>

#include <random>

namespace farcell {
namespace {

std::shared_ptr<ReadMemory> tinyMemory() {
  return ReadMemory::create({kLeastReadMemoryBytes, std::filesystem::temp_directory_path()}).value();
}

// A value that says which row of which array it is.
uint64_t valueOf(uint64_t array, uint64_t row) { return (array << 40) + row * 2654435761u; }

TEST(PagedArray, GivesBackWhatWasAppendedInAnyOrder) {
  const std::shared_ptr<ReadMemory> memory = tinyMemory();
  constexpr uint64_t kRows = 20'000;  // twice the memory, in each of three
  std::vector<PagedArray<uint64_t>> arrays;
  for (int i = 0; i < 3; ++i) arrays.emplace_back(memory);
  for (uint64_t row = 0; row < kRows; ++row)
    for (size_t i = 0; i < arrays.size(); ++i) ASSERT_TRUE(arrays[i].append(valueOf(i, row)));
  std::mt19937_64 random(7);
  for (int i = 0; i < 20'000; ++i) {
    const uint64_t array = random() % arrays.size();
    const uint64_t row = random() % kRows;
    ASSERT_EQ(arrays[array][row], valueOf(array, row)) << "array " << array << " row " << row;
  }
  EXPECT_FALSE(memory->failure());
  EXPECT_LE(memory->peakBytes(), kLeastReadMemoryBytes);
  EXPECT_GE(memory->spilledBytes(), 3 * kRows * sizeof(uint64_t) - kLeastReadMemoryBytes);
}

TEST(PagedArray, NeedsNoScratchWhileMemoryIsEnough) {
  const std::shared_ptr<ReadMemory> memory = ReadMemory::create({uint64_t{4} << 20, "/nonexistent"}).value();
  PagedArray<uint32_t> array(memory);
  for (uint32_t i = 0; i < 100'000; ++i) ASSERT_TRUE(array.append(i));
  for (uint32_t i = 0; i < 100'000; ++i) ASSERT_EQ(array[i], i);
  EXPECT_EQ(memory->spilledBytes(), 0u);
}

TEST(PagedRows, ChangesOutlastTheirPages) {
  const std::shared_ptr<ReadMemory> memory = tinyMemory();
  PagedRows rows(memory, sizeof(uint64_t));
  constexpr uint64_t kRows = 30'000;
  for (uint64_t i = 0; i < kRows; ++i) ASSERT_TRUE(rows.append(&i));
  for (uint64_t i = 0; i < kRows; i += 3) {
    const uint64_t changed = valueOf(1, i);
    std::memcpy(rows.change(i), &changed, sizeof(changed));
  }
  for (uint64_t i = 0; i < kRows; ++i) {
    uint64_t value = 0;
    std::memcpy(&value, rows.row(i), sizeof(value));
    ASSERT_EQ(value, i % 3 == 0 ? valueOf(1, i) : i) << i;
  }
}

TEST(PagedRows, LoadedRowsAreLoadedAgainAfterTheyHadToGo) {
  const std::shared_ptr<ReadMemory> memory = tinyMemory();
  constexpr uint64_t kRows = 50'000;
  uint64_t loads = 0;
  const auto rows = PagedRows::loaded(memory, sizeof(uint64_t), kRows, [&](uint64_t first, std::span<std::byte> out) {
                      ++loads;
                      EXPECT_LE(first + out.size() / sizeof(uint64_t), kRows);
                      for (size_t i = 0; i < out.size() / sizeof(uint64_t); ++i) {
                        const uint64_t value = valueOf(2, first + i);
                        std::memcpy(out.data() + i * sizeof(value), &value, sizeof(value));
                      }
                      return Result<>{};
                    }).value();
  uint64_t firstPass = 0;
  for (int pass = 0; pass < 2; ++pass) {
    for (uint64_t i = 0; i < kRows; ++i) {
      uint64_t value = 0;
      std::memcpy(&value, rows->row(i), sizeof(value));
      ASSERT_EQ(value, valueOf(2, i));
    }
    if (pass == 0) firstPass = loads;
  }
  EXPECT_GT(loads, firstPass);
  EXPECT_LE(loads, 2 * firstPass) << "in order, a page is loaded once a pass";
  EXPECT_EQ(memory->spilledBytes(), 0u) << "what can be loaded needs no scratch";
  EXPECT_LE(memory->peakBytes(), kLeastReadMemoryBytes);
}

TEST(PagedRows, AFailedLoadIsRememberedAndGivesZeros) {
  const std::shared_ptr<ReadMemory> memory = tinyMemory();
  const auto rows = PagedRows::loaded(memory, 8, 1000, [](uint64_t, std::span<std::byte>) -> Result<> {
                      return fail(ErrorKind::io, "no more");
                    }).value();
  const std::vector<std::byte> zeros(8);
  EXPECT_EQ(std::memcmp(rows->row(999), zeros.data(), 8), 0);
  ASSERT_TRUE(memory->failure());
  EXPECT_EQ(memory->failure()->message, "no more");
}

TEST(ReadMemory, PagesGiveWayToClaimsAndClaimsDoNotToOthers) {
  const std::shared_ptr<ReadMemory> memory = tinyMemory();
  PagedArray<uint64_t> array(memory);
  for (uint64_t i = 0; i < 10'000; ++i) ASSERT_TRUE(array.append(i));
  {
    const Result<MemoryClaim> most = memory->claim(kLeastReadMemoryBytes * 3 / 4, "a table");
    ASSERT_TRUE(most) << most.error().message;
    const Result<MemoryClaim> more = memory->claim(kLeastReadMemoryBytes / 2, "another table");
    ASSERT_FALSE(more);
    EXPECT_EQ(more.error().kind, ErrorKind::exhausted);
    EXPECT_TRUE(more.error().message.starts_with("another table: expected")) << more.error().message;
    for (uint64_t i = 0; i < 10'000; ++i) ASSERT_EQ(array[i], i);
  }
  EXPECT_TRUE(memory->claim(kLeastReadMemoryBytes / 2, "another table"));
  EXPECT_LE(memory->peakBytes(), kLeastReadMemoryBytes);
}

TEST(ReadMemory, WhatIsGivenBackIsUsedAgain) {
  const std::shared_ptr<ReadMemory> memory = tinyMemory();
  uint64_t once = 0;
  for (int i = 0; i < 20; ++i) {
    PagedArray<uint64_t> array(memory);
    for (uint64_t row = 0; row < 20'000; ++row) ASSERT_TRUE(array.append(row));
    if (i == 0) once = memory->spilledBytes();
  }
  EXPECT_LE(memory->spilledBytes(), 2 * once) << "twenty arrays, one after the other";
  EXPECT_LE(memory->usedBytes(), kLeastReadMemoryBytes / 16);
}

TEST(ReadMemory, AScratchDirectoryThatIsNotThereIsNamed) {
  const std::shared_ptr<ReadMemory> memory =
      ReadMemory::create({kLeastReadMemoryBytes, "/nonexistent/scratch"}).value();
  PagedArray<uint64_t> array(memory);
  Result<> appended;
  for (uint64_t i = 0; i < 20'000 && appended; ++i) appended = array.append(i);
  ASSERT_FALSE(appended);
  EXPECT_NE(appended.error().message.find("/nonexistent/scratch"), std::string::npos) << appended.error().message;
}

TEST(ReadMemory, TooLittleIsRefused) {
  const auto memory = ReadMemory::create({1000, {}});
  ASSERT_FALSE(memory);
  EXPECT_EQ(memory.error().kind, ErrorKind::invalidArgument);
}

}  // namespace
}  // namespace farcell
