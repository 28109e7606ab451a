#include "preprocess/texture/textures.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>

#include "tests/preprocess/texture/texture_scenes.h"

namespace farcell::test {
namespace {

using Textured = TextureTest;

// Red rises to the right, green from the top row down, blue is 50.
std::string gradient(int width, int height) {
  return encodeImage("png", {width, height, 3, 8}, [&](int x, int y, int channel) {
    return channel == 0 ? 255 * x / (width - 1) : channel == 1 ? 255 * y / (height - 1) : 50;
  });
}

std::string checkerboard(int edge) {
  return encodeImage("png", {edge, edge, 3, 8}, [](int x, int y, int) { return (x + y) % 2 * 255; });
}

TextureLookup square(glm::vec2 at, float side) { return {0, at, glm::vec2(side, 0), glm::vec2(0, side)}; }

TEST_F(Textured, UGoesRightAndVGoesUpFromTheLowestRow) {
  TextureSampler& textures = sampler(source("gradient.png", gradient(256, 256)));
  for (const float u : {0.1f, 0.5f, 0.8f})
    for (const float v : {0.2f, 0.5f, 0.9f})
      expectNear(textures.sample(square({u, v}, 0)), {u, 1 - v, 50 / 255.0f}, 0.004f);
}

TEST_F(Textured, APixelsMiddleIsThePixel) {
  TextureSampler& textures = sampler(source("palette.png", palettePng()));
  const int expected[2][4][3] = {{{255, 0, 0}, {0, 255, 0}, {0, 0, 255}, {255, 255, 255}},
                                 {{0, 0, 0}, {10, 20, 30}, {200, 100, 50}, {128, 128, 128}}};
  for (int y = 0; y < 2; ++y) {
    for (int x = 0; x < 4; ++x) {
      const auto& [red, green, blue] = expected[y][x];
      const glm::vec2 at((static_cast<float>(x) + .5f) / 4, 1 - (static_cast<float>(y) + .5f) / 2);
      expectNear(textures.sample(square(at, 0)), glm::vec3(red, green, blue) / 255.0f, 1e-4f);
    }
  }
}

TEST_F(Textured, AFineCheckerboardGivesItsMean) {
  TextureSampler& textures = sampler(source("checker.png", checkerboard(300)));
  std::mt19937 random(7);
  std::uniform_real_distribution<float> anywhere(-2, 2);
  for (int i = 0; i < 200; ++i)
    expectNear(textures.sample(square({anywhere(random), anywhere(random)}, 8 / 300.0f)), glm::vec3(0.5f), 0.01f);
}

TEST_F(Textured, AnEdgeLiesWhereItIsAtEveryFootprint) {
  const auto halves = encodeImage("png", {256, 128, 3, 8}, [](int x, int, int) { return x < 128 ? 0 : 255; });
  TextureSampler& textures = sampler(source("halves.png", halves, TextureWrap::clamp));
  for (float side = 1 / 256.0f; side < 0.2f; side *= 1.7f) {
    EXPECT_NEAR(textures.sample(square({0.5f, 0.5f}, side)).x, 0.5f, 0.01f) << side;
    EXPECT_NEAR(textures.sample(square({0.5f - 2 * side - .01f, 0.3f}, side)).x, 0, 0.01f) << side;
    EXPECT_NEAR(textures.sample(square({0.5f + 2 * side + .01f, 0.3f}, side)).x, 1, 0.01f) << side;
  }
}

TEST_F(Textured, ALongFootprintDoesNotBlurAcrossItself) {
  const auto halves = encodeImage("png", {256, 256, 3, 8}, [](int x, int, int) { return x < 128 ? 0 : 255; });
  TextureSampler& textures = sampler(source("halves.png", halves, TextureWrap::clamp));
  const auto along = [&](float u) {
    return textures.sample({0, {u, 0.5f}, glm::vec2(4 / 256.0f, 0), glm::vec2(0, 16 / 256.0f)}).x;
  };
  EXPECT_NEAR(along(0.5f - 9 / 256.0f), 0, 0.01f);
  EXPECT_NEAR(along(0.5f + 9 / 256.0f), 1, 0.01f);
}

TEST_F(Textured, TheMeanOfTheImageIsItsLastLevelWhateverItsSize) {
  std::mt19937 random(3);
  for (const auto& [width, height] : {std::pair{1, 1}, {1, 97}, {33, 1}, {101, 67}, {64, 32}, {129, 255}}) {
    std::vector<int> values(static_cast<size_t>(width * height));
    for (int& value : values) value = static_cast<int>(random() % 256);
    const auto bytes = encodeImage("png", {width, height, 1, 8}, [&, w = width](int x, int y, int) {
      return values[static_cast<size_t>(y * w + x)];
    });
    TextureSampler& textures = sampler(source("noise.png", bytes));
    const double mean = std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size()) / 255;
    EXPECT_NEAR(textures.sample(square({0.3f, 0.7f}, 4)).x, mean, 3 / 255.0) << width << " x " << height;
  }
}

TEST_F(Textured, WrapModesRepeatMirrorAndClamp) {
  const std::string bytes = gradient(64, 64);
  const auto red = [&](TextureWrap wrap, float u) {
    return sampler(source("gradient.png", bytes, wrap)).sample(square({u, 0.5f}, 0)).x;
  };
  for (const float u : {-3.3f, -1.8f, -0.3f, 0.4f, 1.2f, 2.7f, 7.6f}) {
    EXPECT_NEAR(red(TextureWrap::repeat, u), u - std::floor(u), 0.02f) << u;
    const float within = u - 2 * std::floor(u / 2);
    EXPECT_NEAR(red(TextureWrap::mirror, u), within < 1 ? within : 2 - within, 0.02f) << u;
    EXPECT_NEAR(red(TextureWrap::clamp, u), std::clamp(u, 0.0f, 1.0f), 0.02f) << u;
  }
  // Across the border a repeated image meets its other side, a clamped one itself.
  EXPECT_NEAR(red(TextureWrap::repeat, 1), 0.5f, 0.02f);
  EXPECT_NEAR(red(TextureWrap::mirror, 1), 1, 0.02f);
  EXPECT_NEAR(red(TextureWrap::clamp, 1), 1, 0.02f);
}

TEST_F(Textured, GreyDeepAndTransparentImagesGiveTheirColours) {
  const auto value = [](int, int, int channel) {
    return channel == 0 ? 200 : channel == 1 ? 100 : channel == 2 ? 50 : 7;
  };
  const glm::vec3 colour = glm::vec3(200, 100, 50) / 255.0f, grey(200 / 255.0f);
  for (const int bits : {8, 16}) {
    for (int channels = 1; channels <= 4; ++channels) {
      const auto bytes = encodeImage("png", {8, 8, channels, bits}, value);
      expectNear(sampler(source("some.png", bytes)).sample(square({.4f, .6f}, 0)), channels < 3 ? grey : colour,
                 0.001f);
    }
  }
  // Fully transparent pixels keep theirs as well: alpha is another matter.
  const auto clear = encodeImage("png", {8, 8, 4, 8}, [&](int x, int y, int c) { return c == 3 ? 0 : value(x, y, c); });
  expectNear(sampler(source("clear.png", clear)).sample(square({.4f, .6f}, 0)), colour, 0.001f);
  expectNear(sampler(source("inter.png", interlacedPng())).sample(square({.4f, .6f}, 0)), colour, 0.001f);
}

TEST_F(Textured, JpegIsReadWhateverItsNameSays) {
  const auto bytes =
      encodeImage("jpeg", {64, 64, 3, 8}, [](int x, int, int channel) { return channel == 0 ? 4 * x : 90; });
  TextureSampler& textures = sampler(source("photo.png", bytes));
  expectNear(textures.sample(square({0.5f, 0.5f}, 0)), {126 / 255.0f, 90 / 255.0f, 90 / 255.0f}, 0.02f);
  const glm::vec3 colour = glm::vec3(200, 100, 50) / 255.0f;
  expectNear(sampler(source("a.jpg", progressiveJpeg())).sample(square({.4f, .6f}, 0)), colour, 0.02f);
  expectNear(sampler(source("b.jpg", cmykJpeg())).sample(square({.4f, .6f}, 0)), colour, 0.02f);
}

TEST_F(Textured, AnImageMayLieInsideAnotherFileOrInMemory) {
  const std::string image = gradient(64, 64);
  TextureSource inside = source("model.glb", std::string(1000, 'x') + image + "more");
  inside.offsetBytes = 1000;
  inside.sizeBytes = image.size();
  expectNear(sampler(inside).sample(square({0.25f, 0.25f}, 0)), {0.25f, 0.75f, 50 / 255.0f}, 0.01f);
  TextureSource embedded;
  embedded.file = "model.gltf";
  const auto* bytes = reinterpret_cast<const std::byte*>(image.data());
  embedded.embedded = std::make_shared<const std::vector<std::byte>>(bytes, bytes + image.size());
  expectNear(sampler(embedded).sample(square({0.25f, 0.25f}, 0)), {0.25f, 0.75f, 50 / 255.0f}, 0.01f);
}

TEST_F(Textured, WhatASideOfTheFootprintIsCalledOrPointsToDoesNotMatter) {
  TextureSampler& textures = sampler(source("checker.png", checkerboard(37)));
  std::mt19937 random(11);
  std::uniform_real_distribution<float> some(-0.2f, 0.2f);
  for (int i = 0; i < 500; ++i) {
    const TextureLookup a{0, {some(random), some(random)}, {some(random), some(random)}, {some(random), some(random)}};
    EXPECT_EQ(textures.sample(a), textures.sample({0, a.at, -a.alongX, a.alongY}));
    EXPECT_EQ(textures.sample(a), textures.sample({0, a.at, a.alongX, -a.alongY}));
  }
}

// More tiles than a sampler keeps, asked for in different orders by samplers of different histories.
TEST_F(Textured, AnAnswerDoesNotDependOnWhatWasAskedBefore) {
  const auto noise = encodeImage("png", {2600, 2400, 3, 8}, [](int x, int y, int channel) {
    return static_cast<int>((static_cast<unsigned>(x * 7919 + y * 104729 + channel) * 2654435761u) >> 24);
  });
  const Textures textures = open({source("noise.png", noise), source("other.png", checkerboard(90))}, 2);
  ASSERT_TRUE(textures.leftOut().empty());
  std::mt19937 random(5);
  std::uniform_real_distribution<float> place(-1, 2), side(0, 0.003f);
  std::vector<TextureLookup> lookups;
  for (int i = 0; i < 20'000; ++i)
    lookups.push_back(
        {static_cast<uint32_t>(i % 2), {place(random), place(random)}, {side(random), 0}, {0, side(random)}});
  const auto first = textures.sampler(), second = textures.sampler();
  std::vector<glm::vec4> answers;
  for (const TextureLookup& lookup : lookups) answers.push_back(first->sample(lookup));
  for (size_t i = lookups.size(); i-- > 0;) ASSERT_EQ(second->sample(lookups[i]), answers[i]) << i;
  EXPECT_FALSE(first->failure() || second->failure());
}

TEST_F(Textured, NumbersThatAreNoneGiveAColour) {
  const float nan = std::numeric_limits<float>::quiet_NaN(), inf = std::numeric_limits<float>::infinity();
  for (const TextureWrap wrap : {TextureWrap::repeat, TextureWrap::mirror, TextureWrap::clamp}) {
    TextureSampler& textures = sampler(source("checker.png", checkerboard(5), wrap));
    for (const float x : {nan, inf, -inf, 3e38f, -3e38f, 1e-40f, 1e6f}) {
      for (const float y : {nan, inf, 3e38f, 0.0f}) {
        const glm::vec4 colour = textures.sample({0, {x, y}, {y, x}, {x, x}});
        for (int channel = 0; channel < 4; ++channel) EXPECT_TRUE(colour[channel] >= 0 && colour[channel] <= 1.0001f);
      }
    }
  }
}

TEST_F(Textured, WhatWasDecodedIsFoundAgainWithoutTheImages) {
  const TextureSource image = source("checker.png", checkerboard(200)), bad = source("bad.png", "no image");
  const Textures made = open({image, bad}, 2);
  std::filesystem::remove(image.file);
  std::filesystem::remove(bad.file);
  const std::optional<Textures> found = Textures::load(work_, 2);
  ASSERT_TRUE(found);
  EXPECT_EQ(found->count(), 2u);
  ASSERT_EQ(found->leftOut().size(), 1u);
  EXPECT_EQ(found->leftOut()[0].message, made.leftOut()[0].message);
  const auto before = made.sampler(), after = found->sampler();
  for (int i = 0; i < 1000; ++i) {
    const auto at = static_cast<float>(i);
    const TextureLookup lookup = square({0.0137f * at, 0.0071f * at}, 0.001f * at);
    ASSERT_EQ(after->sample(lookup), before->sample(lookup)) << i;
  }
  EXPECT_FALSE(Textures::load(work_, 1));
  EXPECT_TRUE(Textures::load(work_, 0)) << "a mesh without textures has left nothing";
}

TEST_F(Textured, WhatIsNotWholeIsNotFound) {
  open({source("checker.png", checkerboard(200))});
  const auto tiles = work_ / "textures.tiles", index = work_ / "textures";
  const uint64_t size = std::filesystem::file_size(tiles);
  std::filesystem::resize_file(tiles, size - 1);
  EXPECT_FALSE(Textures::load(work_, 1));
  std::filesystem::resize_file(tiles, size);
  EXPECT_TRUE(Textures::load(work_, 1));
  std::filesystem::resize_file(index, std::filesystem::file_size(index) - 1);
  EXPECT_FALSE(Textures::load(work_, 1));
  std::filesystem::remove(index);
  EXPECT_FALSE(Textures::load(work_, 1));
}

TEST_F(Textured, AMeshWithoutTexturesNeedsNoScratch) {
  Progress silent(false);
  const auto none = Textures::open({}, "/no/such/directory", 1, silent);
  ASSERT_TRUE(none);
  EXPECT_EQ(none->count(), 0u);
}

}  // namespace
}  // namespace farcell::test
