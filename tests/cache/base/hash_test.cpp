#include "cache/base/hash.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <string>
#include <vector>

namespace farcell {
namespace {

std::vector<std::byte> randomBytes(size_t count, unsigned seed) {
  std::mt19937 random(seed);
  std::vector<std::byte> bytes(count);
  for (std::byte& byte : bytes) byte = static_cast<std::byte>(random());
  return bytes;
}

TEST(Hash, OfNothingIsThePublishedValueOfXxh3) {
  // XXH3_64bits of the empty input with seed 0, from the reference implementation's own test vectors.
  EXPECT_EQ(hashBytes({}), 0x2D06800538D394C2ull);
}

// The input of the reference implementation's self-test (xxhsum sanity check): a byte is the top byte of a running
// product.
std::vector<std::byte> referenceInput(size_t count) {
  constexpr uint64_t kPrime32 = 2654435761u;
  constexpr uint64_t kPrime64 = 11400714785074694797ull;
  std::vector<std::byte> bytes(count);
  uint64_t generator = kPrime32;
  for (std::byte& byte : bytes) {
    byte = static_cast<std::byte>(generator >> 56);
    generator *= kPrime64;
  }
  return bytes;
}

TEST(Hash, MatchesPublishedValuesOfXxh3AtEveryKindOfLength) {
  // XSUM_XXH3_testdata of xxHash's cli/xsum_sanity_check.c, seed 0.
  EXPECT_EQ(hashBytes(referenceInput(1)), 0xC44BDFF4074EECDBull);
  EXPECT_EQ(hashBytes(referenceInput(6)), 0x27B56A84CD2D7325ull);
  EXPECT_EQ(hashBytes(referenceInput(12)), 0xA713DAF0DFBB77E7ull);
  EXPECT_EQ(hashBytes(referenceInput(24)), 0xA3FE70BF9D3510EBull);
  EXPECT_EQ(hashBytes(referenceInput(48)), 0x397DA259ECBA1F11ull);
  EXPECT_EQ(hashBytes(referenceInput(80)), 0xBCDEFBBB2C47C90Aull);
  EXPECT_EQ(hashBytes(referenceInput(195)), 0xCD94217EE362EC3Aull);
}

TEST(Hash, StreamedInAnyPiecesIsTheSameAsInOne) {
  const unsigned seed = 20101;
  SCOPED_TRACE(seed);
  const std::vector<std::byte> bytes = randomBytes(100'000, seed);
  std::mt19937 random(seed + 1);
  for (int round = 0; round < 50; ++round) {
    Hasher hasher;
    for (size_t at = 0; at < bytes.size();) {
      const size_t size = std::min<size_t>(bytes.size() - at, random() % (round % 2 ? 300 : 30'000));
      hasher.add(std::span(bytes).subspan(at, size));
      at += size;
    }
    ASSERT_EQ(hasher.value(), hashBytes(bytes));
  }
}

TEST(Hash, AskingForTheValueDoesNotEndTheStream) {
  const std::vector<std::byte> bytes = randomBytes(1000, 7);
  Hasher hasher;
  EXPECT_EQ(hasher.value(), hashBytes({}));
  hasher.add(std::span(bytes).first(400));
  EXPECT_EQ(hasher.value(), hashBytes(std::span(bytes).first(400)));
  hasher.add(std::span(bytes).subspan(400));
  EXPECT_EQ(hasher.value(), hashBytes(bytes));
}

TEST(Hash, EverySingleBitMatters) {
  std::vector<std::byte> bytes = randomBytes(600, 11);
  const uint64_t original = hashBytes(bytes);
  for (size_t bit = 0; bit < bytes.size() * 8; ++bit) {
    const std::byte mask = static_cast<std::byte>(1u << bit % 8);
    bytes[bit / 8] ^= mask;
    ASSERT_NE(hashBytes(bytes), original) << "bit " << bit;
    bytes[bit / 8] ^= mask;
  }
}

}  // namespace
}  // namespace farcell
