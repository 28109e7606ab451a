#include <algorithm>
#include <cmath>
#include <random>

#include "preprocess/texture/image_rows.h"
#include "tests/preprocess/texture/texture_scenes.h"

namespace farcell::test {
namespace {

using Transparent = TextureTest;

TextureLookup squareAt(glm::vec2 at, float side) { return {0, at, glm::vec2(side, 0), glm::vec2(0, side)}; }

std::string pngOf(int edge, int channels, const std::function<int(int x, int y, int channel)>& value, int bits = 8) {
  return encodeImage("png", {edge, edge, channels, bits}, value);
}

// Green of alpha 1 in squares of `size` pixels, red of alpha 0 in the others.
std::string greenSquares(int edge, int size) {
  return pngOf(edge, 4, [=](int x, int y, int channel) {
    const bool green = (x / size + y / size) % 2 == 0;
    return channel == 2 ? 0 : channel == 0 ? (green ? 0 : 255) : (green ? 255 : 0);
  });
}

TEST_F(Transparent, EveryKindOfPngKeepsItsAlpha) {
  const auto grey = pngOf(2, 2, [](int, int, int channel) { return channel == 0 ? 100 : 60; });
  const auto colour = pngOf(2, 4, [](int, int, int channel) { return channel == 3 ? 60 : 100; });
  const auto deep = pngOf(
      2, 4, [](int, int, int channel) { return channel == 3 ? 60 : 100; }, 16);
  for (const std::string& bytes : {grey, colour, deep}) {
    TextureSource image = source("image.png", bytes);
    image.surface.alpha = AlphaMode::blend;
    EXPECT_EQ(readTextureImage(image)->pixels[0], 0x3c646464u);
  }
  TextureSource palette = source("palette.png", palettePngWithAlpha());
  palette.surface.alpha = AlphaMode::blend;
  EXPECT_EQ(readTextureImage(palette)->pixels, (std::vector<uint32_t>{0xff0000ffu, 0x3300ff00u, 0xffff0000u}));
}

TEST_F(Transparent, OpaqueSourcesIgnoreAlphaAndJpegHasNone) {
  TextureSource image = source("image.png", greenSquares(8, 1));
  image.opacity = 0.25f;
  TextureSampler& textures = sampler(image);
  EXPECT_TRUE(textures.surface(0).whole());
  const glm::vec4 found = textures.sample(squareAt({0.5f, 0.5f}, 1));
  expectNear(found, glm::vec3(0.5f, 0.5f, 0), 0.01f);
  EXPECT_EQ(found.w, 1);
  TextureSource jpeg = source("image.jpg", encodeImage("jpeg", {16, 16, 3, 8}, [](int, int, int) { return 90; }));
  jpeg.surface.alpha = AlphaMode::blend;
  EXPECT_EQ(sampler(jpeg).sample(squareAt({0.5f, 0.5f}, 0)).w, 1);
}

TEST_F(Transparent, WhatIsTransparentColoursNothing) {
  for (const AlphaMode mode : {AlphaMode::mask, AlphaMode::blend}) {
    TextureSource image = source("image.png", greenSquares(64, 4));
    image.surface.alpha = mode;
    TextureSampler& textures = sampler(image);
    std::mt19937 random(3);
    std::uniform_real_distribution<float> anywhere(0, 1);
    double alpha = 0;
    constexpr int kLooks = 3000;
    for (int i = 0; i < kLooks; ++i) {
      const float side = 0.25f * anywhere(random) * anywhere(random);
      const glm::vec4 found = textures.sample(squareAt({anywhere(random), anywhere(random)}, side));
      alpha += found.w / kLooks;
      if (found.w > 0) {
        expectNear(found, glm::vec3(0, 1, 0), 1e-3f);
      }
      if (found.w == 0) {
        expectNear(found, glm::vec3(0), 0);
      }
    }
    EXPECT_NEAR(alpha, 0.5, 0.03);
  }
}

TEST_F(Transparent, AMaskIsAllOrNothingUntilItIsMadeSmaller) {
  TextureSource image = source("image.png", pngOf(16, 4, [](int x, int, int) { return 17 * x; }), TextureWrap::clamp);
  image.surface.alpha = AlphaMode::mask;
  image.surface.cutoff = 0.3f;
  TextureSampler& textures = sampler(image);
  // Alpha (16 u - .5) / 15 between the middles of the outer pixels.
  const float edge = (0.3f * 15 + 0.5f) / 16;
  for (float u = 0.01f; u < 1; u += 0.013f)
    EXPECT_EQ(textures.sample(squareAt({u, 0.5f}, 1 / 16.0f)).w, u < edge ? 0 : 1) << u;
  // Of the whole image what lies beyond the cutoff, not whether the mean does: 11 of 16 columns.
  EXPECT_NEAR(textures.sample(squareAt({0.5f, 0.5f}, 16)).w, 0, 1);
  EXPECT_NEAR(textures.sample(squareAt({0.5f, 0.5f}, 0.5f)).w, 11 / 16.0, 0.08);
}

TEST_F(Transparent, CutoffsMayLieAnywhere) {
  TextureSource image = source("image.png", greenSquares(32, 8));
  image.surface.alpha = AlphaMode::mask;
  const auto alphaAt = [&](float cutoff, glm::vec2 at, float side) {
    image.surface.cutoff = cutoff;
    return sampler(image).sample(squareAt(at, side)).w;
  };
  for (const float side : {0.0f, 0.1f}) {
    EXPECT_EQ(alphaAt(0, {0.4f, 0.4f}, side), 1);
    EXPECT_EQ(alphaAt(2, {0.1f, 0.4f}, side), 0);
  }
}

TEST_F(Transparent, OpacityMultipliesAlphaAndNeedsNoImage) {
  TextureSource image = source("image.png", pngOf(4, 2, [](int, int, int) { return 200; }));
  image.surface.alpha = AlphaMode::blend;
  image.opacity = 0.5f;
  EXPECT_NEAR(sampler(image).sample(squareAt({0.5f, 0.5f}, 0)).w, 100 / 255.0, 1e-5);
  TextureSource plain;
  plain.surface = {.hasImage = false, .doubleSided = false, .alpha = AlphaMode::blend};
  plain.opacity = 0.2f;
  TextureSampler& white = sampler(plain);
  const glm::vec4 found = white.sample(squareAt({17, -3}, 100));
  expectNear(found, glm::vec3(1), 1e-6f);
  EXPECT_NEAR(found.w, 51 / 255.0, 1e-6);
  EXPECT_EQ(white.surface(0), plain.surface);
}

TEST_F(Transparent, WithoutImageAndAlphaThereIsNothingToLookAt) {
  TextureSource oneSided;
  oneSided.surface = {.hasImage = false, .doubleSided = false};
  EXPECT_EQ(sampler(oneSided).shape(0).width, 0);
  TextureSource glass = oneSided;
  glass.surface.alpha = AlphaMode::blend;
  EXPECT_EQ(sampler(glass).shape(0).width, 1);
}

TEST_F(Transparent, ABrokenImageIsOpaqueAndKeepsItsSides) {
  TextureSource bad = source("bad.png", "no image");
  bad.surface = {.doubleSided = false, .alpha = AlphaMode::mask};
  Textures textures = open({bad});
  EXPECT_EQ(textures.leftOut().size(), 1u);
  EXPECT_EQ(textures.sampler()->sample(squareAt({0.5f, 0.5f}, 0)), glm::vec4(1));
  EXPECT_EQ(textures.sampler()->surface(0).alpha, AlphaMode::opaque);
  EXPECT_FALSE(textures.sampler()->surface(0).doubleSided);
}

TEST_F(Transparent, KindsOfSurfacesAreKeptInTheWorkDirectory) {
  TextureSource image = source("image.png", greenSquares(32, 8));
  image.surface = {.doubleSided = false, .alpha = AlphaMode::mask, .cutoff = 0.7f};
  open({image});
  const std::optional<Textures> again = Textures::load(work_, 1);
  ASSERT_TRUE(again);
  EXPECT_EQ(again->sampler()->surface(0), image.surface);
}

}  // namespace
}  // namespace farcell::test
