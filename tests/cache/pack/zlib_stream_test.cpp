#include "cache/pack/zlib_stream.h"

#include <gtest/gtest.h>
#include <zlib.h>

#include "tests/cache/pack/samples.h"

namespace farcell {
namespace {

using samples::Bytes;

Bytes sample(size_t size, uint32_t seed) {
  std::mt19937 random(seed);
  Bytes bytes(size);
  for (std::byte& b : bytes) b = static_cast<std::byte>(random() % 7 * 31);
  return bytes;
}

TEST(ZlibStream, IsReadByZlib) {
  for (const size_t size : {0, 1, 2, 1000, 70000, 1 << 20}) {
    const Bytes raw = sample(size, 1);
    for (const int level : {1, 6, 12}) {
      const Bytes stream = zlibCompress(raw, level);
      Bytes back(size + 1);
      uLongf length = back.size();
      ASSERT_EQ(uncompress(reinterpret_cast<Bytef*>(back.data()), &length,
                           reinterpret_cast<const Bytef*>(stream.data()), stream.size()),
                Z_OK)
          << size;
      back.resize(length);
      EXPECT_EQ(back, raw);
    }
  }
}

TEST(ZlibStream, ReadsWhatZlibWrites) {
  const Bytes raw = sample(100000, 2);
  Bytes stream(compressBound(raw.size()));
  uLongf length = stream.size();
  ASSERT_EQ(compress2(reinterpret_cast<Bytef*>(stream.data()), &length, reinterpret_cast<const Bytef*>(raw.data()),
                      raw.size(), 9),
            Z_OK);
  stream.resize(length);
  Bytes back(raw.size());
  ASSERT_TRUE(zlibDecompress(stream, back).has_value());
  EXPECT_EQ(back, raw);
}

TEST(ZlibStream, RefusesOtherSizesTrailingBytesAndDamage) {
  const Bytes raw = sample(5000, 3);
  Bytes stream = zlibCompress(raw, 6);
  Bytes shorter(raw.size() - 1), longer(raw.size() + 1), exact(raw.size());
  EXPECT_FALSE(zlibDecompress(stream, shorter).has_value());
  EXPECT_FALSE(zlibDecompress(stream, longer).has_value());
  for (size_t i = 0; i < stream.size(); ++i) {
    Bytes damaged = stream;
    damaged[i] ^= std::byte{0x10};
    EXPECT_FALSE(zlibDecompress(damaged, exact).has_value()) << i;
  }
  stream.push_back(std::byte{0});
  EXPECT_FALSE(zlibDecompress(stream, exact).has_value());
}

// The bound that decoders reject claims by: the best case of deflate stays below it.
TEST(ZlibStream, NeverHoldsMoreThanTheStatedRatio) {
  const Bytes zeros(size_t{1} << 24);
  Bytes stream(compressBound(zeros.size()));
  uLongf length = stream.size();
  ASSERT_EQ(compress2(reinterpret_cast<Bytef*>(stream.data()), &length, reinterpret_cast<const Bytef*>(zeros.data()),
                      zeros.size(), 9),
            Z_OK);
  EXPECT_LE(zeros.size(), kMaxZlibRatio * length);
  EXPECT_LE(zeros.size(), kMaxZlibRatio * zlibCompress(zeros, 12).size());
  EXPECT_GT(zeros.size(), 900 * length);
}

}  // namespace
}  // namespace farcell
