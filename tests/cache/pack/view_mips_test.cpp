#include "cache/pack/view_mips.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace farcell {
namespace {

ViewImage randomView(uint32_t x0, uint32_t y0, uint32_t width, uint32_t height) {
  std::mt19937 random(8);
  ViewImage view{
      .view = 0, .x0 = x0, .y0 = y0, .width = width, .height = height, .rgba = {}, .depth = {}, .normal = {}};
  for (uint32_t i = 0; i < 4 * width * height; ++i) view.rgba.push_back(static_cast<uint8_t>(random()));
  for (uint32_t i = 0; i < width * height; ++i) view.depth.push_back(static_cast<uint8_t>(random()));
  return view;
}

TEST(ViewMips, theCropLiesInItsPlaceAndAllElseIsTransparent) {
  const ViewImage view = randomView(3, 5, 7, 2);
  const auto colour = buildColourMips(view, 16)[0];
  const auto depth = buildDepthImage(view, 16);
  for (uint32_t y = 0; y < 16; ++y)
    for (uint32_t x = 0; x < 16; ++x) {
      const bool inside = x >= 3 && x < 10 && y >= 5 && y < 7;
      const size_t from = inside ? (y - 5) * 7 + (x - 3) : 0;
      for (size_t channel = 0; channel < 4; ++channel)
        EXPECT_EQ(colour[(y * 16 + x) * 4 + channel], inside ? view.rgba[from * 4 + channel] : 0);
      EXPECT_EQ(depth[y * 16 + x], inside ? view.depth[from] : 0);
    }
}

TEST(ViewMips, eachLevelIsTheMeanOfTheImageBelow) {
  const ViewImage view = randomView(0, 0, 32, 32);
  const auto levels = buildColourMips(view, 32);
  ASSERT_EQ(static_cast<int>(levels.size()), mipLevelCount(32));
  ASSERT_EQ(levels.size(), 6u);
  for (size_t level = 0; level < levels.size(); ++level) {
    const size_t edge = 32u >> level, block = 1u << level;
    ASSERT_EQ(levels[level].size(), edge * edge * 4);
    for (size_t i = 0; i < edge * edge * 4; ++i) {
      double sum = 0;
      for (size_t k = 0; k < block * block; ++k) {
        const size_t x = i / 4 % edge * block + k % block, y = i / 4 / edge * block + k / block;
        sum += levels[0][(y * 32 + x) * 4 + i % 4];
      }
      // Each level rounds once by at most a half.
      EXPECT_NEAR(levels[level][i], sum / static_cast<double>(block * block), 0.5 * static_cast<double>(level) + 1e-9);
    }
  }
}

TEST(ViewMips, normalsArePremultipliedAsColoursAreAndHalvedAlike) {
  ViewImage view = randomView(2, 4, 2, 2);
  // Along x, full length, half covered; along -y, half of it; two that are not there.
  view.rgba = {0, 0, 0, 128, 0, 0, 0, 255, 0, 0, 0, 0, 0, 0, 0, 0};
  view.normal = {255, 128, 255, 128, 0, 128, 0, 0, 0, 0, 0, 0};
  const auto levels = buildNormalMips(view, 16);
  ASSERT_EQ(static_cast<int>(levels.size()), mipLevelCount(16));
  const auto expectAt = [&](size_t level, size_t texel, int x, int y, int z) {
    const int8_t* found = &levels[level][4 * texel];
    EXPECT_NEAR(found[0], x, 1) << level;
    EXPECT_NEAR(found[1], y, 1) << level;
    EXPECT_NEAR(found[2], z, 1) << level;
  };
  expectAt(0, 4 * 16 + 2, 64, 0, 0);
  expectAt(0, 4 * 16 + 3, 0, -64, 0);
  expectAt(0, 5 * 16 + 2, 0, 0, 0);
  expectAt(0, 0, 0, 0, 0);
  expectAt(1, 2 * 8 + 1, 16, -16, 0);
  expectAt(2, 1 * 4 + 0, 4, -4, 0);
}

}  // namespace
}  // namespace farcell
