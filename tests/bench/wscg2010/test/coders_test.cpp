#include "tests/bench/wscg2010/measure/coders.h"

#include <gtest/gtest.h>
#include <lzma.h>
#include <webp/decode.h>
#include <zlib.h>

#include <random>

namespace farcell::wscg {
namespace {

// Half of it empty, half a noisy slope.
CellImage sampleImage() {
  CellImage image{3, 5, 40, 30, {}};
  std::mt19937 random(7);
  for (int i = 0; i < image.width * image.height; ++i) {
    const bool covered = i % image.width > 20;
    for (int channel = 0; channel < 3; ++channel)
      image.rgba.push_back(covered ? static_cast<uint8_t>(100 + i % 60 + random() % 4) : uint8_t{0});
    image.rgba.push_back(covered ? 255 : 0);
  }
  return image;
}

const uint8_t* dataOf(const std::vector<std::byte>& bytes) { return reinterpret_cast<const uint8_t*>(bytes.data()); }

TEST(Coders, NothingIsLostAndEachSavesSomething) {
  const CellImage image = sampleImage();
  std::vector<uint8_t> back(image.rgba.size());
  const auto deflated = zlibCoded(image.rgba, 6);
  ASSERT_TRUE(deflated) << deflated.error().message;
  uLongf size = back.size();
  ASSERT_EQ(uncompress(back.data(), &size, dataOf(*deflated), deflated->size()), Z_OK);
  EXPECT_EQ(back, image.rgba);

  const auto packed = xzCoded(image.rgba, 6);
  ASSERT_TRUE(packed) << packed.error().message;
  std::fill(back.begin(), back.end(), uint8_t{0});
  uint64_t memory = UINT64_MAX;
  size_t in = 0, out = 0;
  ASSERT_EQ(lzma_stream_buffer_decode(&memory, 0, nullptr, dataOf(*packed), &in, packed->size(), back.data(), &out,
                                      back.size()),
            LZMA_OK);
  EXPECT_EQ(back, image.rgba);

  const auto webp = webpCoded(image, 4);
  ASSERT_TRUE(webp) << webp.error().message;
  std::fill(back.begin(), back.end(), uint8_t{0});
  ASSERT_NE(WebPDecodeRGBAInto(dataOf(*webp), webp->size(), back.data(), back.size(), 4 * image.width), nullptr);
  EXPECT_EQ(back, image.rgba);

  for (const size_t coded : {deflated->size(), packed->size(), webp->size(), planesCoded(image).size()})
    EXPECT_LT(coded, image.rgba.size() / 2);
}

}  // namespace
}  // namespace farcell::wscg
