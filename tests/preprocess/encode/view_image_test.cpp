#include "preprocess/encode/view_image.h"

#include <gtest/gtest.h>

#include <limits>

namespace farcell {
namespace {

constexpr float kEmpty = -std::numeric_limits<float>::infinity();

// Three texels in a row: full, empty, half covered.
BakedView rowOfThree() {
  BakedView baked;
  baked.x0 = 10;
  baked.y0 = 20;
  baked.width = 3;
  baked.height = 1;
  baked.rgba = {1, 0.5f, 0, 1, 0, 0, 0, 0, 0.25f, 0.25f, 0.25f, 0.5f};
  baked.depth = {-0.5f, kEmpty, 0.5f};
  return baked;
}

TEST(QuantisedView, GrowsTheRectangleByTheTexelThatDepthGrows) {
  const ViewImage image = quantisedView(rowOfThree(), 7, 128);
  EXPECT_EQ(image.view, 7u);
  EXPECT_EQ(image.x0, 9u);
  EXPECT_EQ(image.y0, 19u);
  EXPECT_EQ(image.width, 5u);
  EXPECT_EQ(image.height, 3u);
}

TEST(QuantisedView, GrowsDepthButNotCoverage) {
  const ViewImage image = quantisedView(rowOfThree(), 0, 128);
  EXPECT_EQ(image.depthMin, -0.5f);
  EXPECT_EQ(image.depthMax, 0.5f);
  const auto depthAt = [&](size_t x, size_t y) { return int{image.depth[y * 5 + x]}; };
  EXPECT_EQ(depthAt(1, 1), 1);
  EXPECT_EQ(depthAt(3, 1), 255);
  EXPECT_EQ(depthAt(2, 1), 128) << "the empty texel between takes the mean of its neighbours";
  EXPECT_EQ(depthAt(0, 0), 1);
  EXPECT_EQ(depthAt(4, 2), 255);
  const std::vector<uint8_t> full = {255, 128, 0, 255}, none = {0, 0, 0, 0}, half = {64, 64, 64, 128};
  const auto texel = [&](size_t x, size_t y) {
    const auto first = image.rgba.begin() + static_cast<std::ptrdiff_t>(4 * (y * 5 + x));
    return std::vector<uint8_t>(first, first + 4);
  };
  EXPECT_EQ(texel(1, 1), full);
  EXPECT_EQ(texel(2, 1), none);
  EXPECT_EQ(texel(3, 1), half);
  EXPECT_EQ(texel(0, 0), none);
}

TEST(QuantisedView, StaysInsideTheImage) {
  BakedView baked = rowOfThree();
  baked.x0 = 0;
  baked.y0 = 127;
  const ViewImage image = quantisedView(baked, 0, 128);
  EXPECT_EQ(image.x0, 0u);
  EXPECT_EQ(image.y0, 126u);
  EXPECT_EQ(image.width, 4u);
  EXPECT_EQ(image.height, 2u);
}

TEST(QuantisedView, AFlatSurfaceHasADepthRangeOfNothing) {
  BakedView baked = rowOfThree();
  baked.depth = {0.25f, kEmpty, 0.25f};
  const ViewImage image = quantisedView(baked, 0, 128);
  EXPECT_EQ(image.depthMin, image.depthMax);
  EXPECT_EQ(image.depth[5 + 1], 1);
}

TEST(QuantisedView, AnEmptyViewHasNoSize) {
  const ViewImage image = quantisedView(BakedView{}, 3, 128);
  EXPECT_EQ(image.width, 0u);
  EXPECT_TRUE(image.rgba.empty());
}

}  // namespace
}  // namespace farcell
