#include <gtest/gtest.h>
#include <zlib.h>

#include "tests/cache/pack/samples.h"

namespace farcell {
namespace {

using samples::Bytes;
using samples::randomAtlas;

constexpr size_t kTextureHeaderBytes = 24;

Result<TexturePage> decode(std::span<const std::byte> bytes, uint64_t most) {
  return decodeTexturePage(Bytes(bytes.begin(), bytes.end()), {most});
}

// By FORMAT.md, with zlib and without any of the library's code.
TexturePage plainlyDecoded(const Bytes& bytes) {
  const auto word = [&](size_t index) {
    uint32_t value = 0;
    for (size_t i = 4; i-- > 0;) value = value << 8 | std::to_integer<uint32_t>(bytes[4 * index + i]);
    return value;
  };
  TexturePage page{word(0), word(1), word(2), word(3), word(4), {}};
  const uint32_t levels = word(5), channels = page.channels;
  std::vector<uint8_t> payload(size_t{1} << 20);
  uLongf size = payload.size();
  EXPECT_EQ(uncompress(payload.data(), &size, reinterpret_cast<const Bytef*>(bytes.data() + kTextureHeaderBytes),
                       bytes.size() - kTextureHeaderBytes),
            Z_OK);
  size_t at = size_t{levels} * channels;
  for (uint32_t i = 0; i < levels; ++i) {
    const int width = static_cast<int>(page.width >> (page.firstLevel + i));
    const int height = static_cast<int>(page.height >> (page.firstLevel + i));
    std::vector<std::vector<int>> planes(channels, std::vector<int>(static_cast<size_t>(width * height)));
    for (const uint32_t channel : std::vector<uint32_t>{1, 0, 2, 3}) {
      if (channel >= channels) continue;
      const int filter = payload.at(i * channels + channel);
      std::vector<int>& plane = planes[channel];
      const auto texel = [&](int x, int y) { return x < 0 || y < 0 ? 0 : plane[static_cast<size_t>(y * width + x)]; };
      for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
          const int up = texel(x, y - 1), left = texel(x - 1, y);
          const int guesses[] = {0, up, left, (up + left) / 2, left + up - texel(x - 1, y - 1)};
          plane[static_cast<size_t>(y * width + x)] = (payload.at(at++) + guesses[filter]) & 255;
        }
    }
    auto& texels = page.levels.emplace_back();
    for (size_t t = 0; t < planes[0].size(); ++t)
      for (uint32_t channel = 0; channel < channels; ++channel) {
        const int green = channel == 0 || channel == 2 ? planes[1][t] : 0;
        texels.push_back(static_cast<uint8_t>(planes[channel][t] + green));
      }
  }
  EXPECT_EQ(at, size);
  return page;
}

TEST(TexturePageCoding, ReturnsEveryAtlasAndIsWhatFormatMdSays) {
  for (uint32_t seed = 0; seed < 30; ++seed) {
    SCOPED_TRACE(seed);
    std::mt19937 random(seed);
    const uint32_t levels = 1 + seed % kMaxAtlasLevels, unit = 1u << (levels - 1);
    const uint32_t width = unit * (1 + samples::below(random, 96 / unit)),
                   height = unit * (1 + samples::below(random, 5));
    const TexturePage atlas = randomAtlas(random, width, height, 3 + seed % 2, levels);
    std::vector<TexturePage> pages;
    for (const TexturePage& page : pagesOfAtlas(atlas)) {
      const Bytes bytes = encodeTexturePage(page);
      const auto decoded = decode(bytes, decodedSizeBytes(page));
      ASSERT_TRUE(decoded.has_value()) << decoded.error().message;
      EXPECT_EQ(*decoded, page);
      EXPECT_EQ(plainlyDecoded(bytes), page);
      pages.push_back(*decoded);
    }
    EXPECT_EQ(atlasOfPages(pages), atlas);
  }
}

TEST(TexturePageCoding, PutsFineLevelsIntoPagesOfTheirOwn) {
  std::mt19937 random(3);
  const TexturePage atlas = randomAtlas(random, 1056, 544, 3, 6);
  const std::vector<TexturePage> pages = pagesOfAtlas(atlas);
  ASSERT_EQ(pages.size(), 3u);  // 264 x 136 is the first level of at most 2^16 texels
  EXPECT_EQ(pages[0].firstLevel, 2u);
  EXPECT_EQ(pages[0].levels.size(), 4u);
  EXPECT_EQ(pages[1].firstLevel, 1u);
  EXPECT_EQ(pages[2].firstLevel, 0u);
  EXPECT_EQ(pages[2].levels.size(), 1u);
  EXPECT_FALSE(atlasOfPages(std::vector{pages[0], pages[2]}));
  EXPECT_FALSE(atlasOfPages(std::span(pages).first(2)));
}

TEST(TexturePageCoding, SmallerPagesHoldTheSame) {
  std::mt19937 random(5);
  const TexturePage atlas = randomAtlas(random, 128, 64, 3, 4);
  const Bytes bytes = encodeTexturePage(atlas);
  const TextureLimits limits{decodedSizeBytes(atlas)};
  const Result<Bytes> smaller = smallerTexturePage(bytes, limits);
  ASSERT_TRUE(smaller.has_value());
  EXPECT_LE(smaller->size(), bytes.size());
  EXPECT_EQ(decodeTexturePage(*smaller, limits), atlas);
}

TEST(TexturePageCoding, RefusesTruncationsLimitsAndHeadersThatLie) {
  std::mt19937 random(8);
  const TexturePage atlas = randomAtlas(random, 24, 16, 3, 4);
  const Bytes bytes = encodeTexturePage(atlas);
  const uint32_t most = decodedSizeBytes(atlas);
  for (size_t size = 0; size < bytes.size(); ++size) EXPECT_FALSE(decode(std::span(bytes).first(size), most)) << size;
  Bytes longer = bytes;
  longer.push_back({});
  EXPECT_FALSE(decode(longer, most));
  EXPECT_FALSE(decode(bytes, most - 1));
  struct Lie {
    size_t field;
    uint32_t value;
  };
  for (const Lie& lie : {Lie{0, 0},
                         {0, 20},
                         {0, 1u << 20},
                         {1, 8},
                         {2, 2},
                         {2, 5},
                         {3, 0},
                         {3, 7},
                         {4, 1},
                         {4, 4},
                         {4, ~0u},
                         {5, 0},
                         {5, 5},
                         {5, ~0u}}) {
    Bytes lying = bytes;
    for (size_t i = 0; i < 4; ++i) lying[4 * lie.field + i] = static_cast<std::byte>(lie.value >> (8 * i));
    EXPECT_FALSE(decode(lying, ~0u)) << lie.field << " " << lie.value;
  }
}

TEST(TexturePageCoding, SurvivesEveryFlippedBit) {
  std::mt19937 random(9);
  const TexturePage atlas = randomAtlas(random, 16, 8, 4, 4);
  const Bytes bytes = encodeTexturePage(atlas);
  for (size_t bit = 0; bit < 8 * bytes.size(); ++bit) {
    Bytes flipped = bytes;
    flipped[bit / 8] ^= static_cast<std::byte>(1 << bit % 8);
    const auto decoded = decode(flipped, decodedSizeBytes(atlas));
    if (decoded) {
      EXPECT_LE(decodedSizeBytes(*decoded), decodedSizeBytes(atlas));
    }
  }
}

}  // namespace
}  // namespace farcell
