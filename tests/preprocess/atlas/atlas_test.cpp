#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "preprocess/atlas/atlas.h"
#include "preprocess/atlas/atlas_sampler.h"
#include "preprocess/atlas/packing.h"

namespace farcell {
namespace {

// Smooth colours of period 1 (or reflected, or held), as if from an image of that many texels.
class WaveSampler final : public TextureSampler {
 public:
  explicit WaveSampler(TextureWrap wrap, int edge = 256) : wrap_(wrap), edge_(edge) {}
  static glm::vec3 colourAt(glm::dvec2 at, TextureWrap wrap, uint32_t texture) {
    for (int axis = 0; axis < 2; ++axis) {
      if (wrap == TextureWrap::clamp) at[axis] = std::min(std::max(at[axis], 0.0), 1.0);
      if (wrap == TextureWrap::mirror) at[axis] = std::abs(at[axis] - 2 * std::floor(at[axis] / 2 + 0.5));
    }
    const auto wave = [](double x) { return static_cast<float>(0.5 + 0.4 * std::cos(2 * M_PI * x)); };
    return glm::vec3(wave(at.x), wave(at.y), wave(at.x + at.y + 0.1 * texture));
  }
  glm::vec4 sample(const TextureLookup& lookup) override {
    return {colourAt(glm::dvec2(lookup.at), wrap_, lookup.texture), 1};
  }
  TextureShape shape(uint32_t texture) const override {
    if (texture == 7) return {};  // could not be read
    return {edge_, edge_ / 2, wrap_, wrap_};
  }
  const std::optional<Error>& failure() const override { return failure_; }

 private:
  TextureWrap wrap_;
  int edge_;
  std::optional<Error> failure_;
};

std::vector<TriangleTexture> randomTriangles(std::mt19937& random, size_t count, float extent, float size) {
  std::uniform_real_distribution<float> place(-extent, extent), near(-size, size);
  std::vector<TriangleTexture> triangles;
  for (size_t i = 0; i < count; ++i) {
    TriangleTexture& triangle = triangles.emplace_back();
    const uint32_t kind = static_cast<uint32_t>(random() % 6);
    triangle.texture = kind == 0 ? kNoTexture : kind;
    const glm::vec2 at(place(random), place(random));
    for (glm::vec2& corner : triangle.coordinates) corner = at + glm::vec2(near(random), near(random));
  }
  return triangles;
}

// At corners, inside and on edges: the colour of the source, at a texel's size.
void expectSourceColours(const std::vector<TriangleTexture>& triangles, const Atlas& atlas, TextureWrap wrap,
                         float tolerance) {
  AtlasSampler sampler({atlas.image});
  for (size_t i = 0; i < triangles.size(); ++i) {
    const auto corner = [&](size_t k) { return unpackedCoordinates(atlas.coordinates[i][k]); };
    for (const glm::dvec3 weights :
         {glm::dvec3(1, 0, 0), glm::dvec3(0, 0, 1), glm::dvec3(0.5, 0.5, 0), glm::dvec3(0.3, 0.3, 0.4)}) {
      glm::dvec2 source(0), at(0);
      for (int k = 0; k < 3; ++k) {
        source += weights[k] * glm::dvec2(triangles[i].coordinates[static_cast<size_t>(k)]);
        at += weights[k] * glm::dvec2(corner(static_cast<size_t>(k)));
      }
      const glm::vec3 found(sampler.sample({0, glm::vec2(at), {}, {}}));
      const bool textured = triangles[i].texture != kNoTexture && triangles[i].texture != 7;
      const glm::vec3 wanted = textured ? WaveSampler::colourAt(source, wrap, triangles[i].texture) : glm::vec3(1);
      for (int channel = 0; channel < 3; ++channel)
        ASSERT_NEAR(found[channel], wanted[channel], tolerance) << "triangle " << i << ", channel " << channel;
    }
  }
}

TEST(Atlas, showsWhatTheTexturesShow) {
  for (uint32_t seed = 0; seed < 6; ++seed) {
    SCOPED_TRACE(seed);
    std::mt19937 random(seed);
    const TextureWrap wrap = std::array{TextureWrap::repeat, TextureWrap::mirror, TextureWrap::clamp}[seed % 3];
    const auto triangles = randomTriangles(random, 40, wrap == TextureWrap::clamp ? 1.0f : 20.0f, 0.2f);
    WaveSampler sampler(wrap);
    const std::optional<Atlas> atlas = atlasOf(triangles, sampler);
    ASSERT_TRUE(atlas.has_value());
    EXPECT_LE(std::max(atlas->image.width, atlas->image.height), kMaxTextureEdge);
    expectSourceColours(triangles, *atlas, wrap, 0.03f);
    const std::optional<Atlas> again = atlasOf(triangles, sampler);
    EXPECT_EQ(again->image, atlas->image);
    EXPECT_EQ(again->coordinates, atlas->coordinates);
  }
}

TEST(Atlas, repeatsAnImageOnceWhereTrianglesLieAPeriodApart) {
  std::vector<TriangleTexture> triangles;
  for (int i = 0; i < 100; ++i) {
    const auto at = static_cast<float>(i);
    triangles.push_back({1, {glm::vec2(at, at), glm::vec2(at + 1, at), glm::vec2(at, at + 1)}});
  }
  WaveSampler sampler(TextureWrap::repeat);
  const std::optional<Atlas> atlas = atlasOf(triangles, sampler);
  ASSERT_TRUE(atlas.has_value());
  EXPECT_LE(uint64_t{atlas->image.width} * atlas->image.height, uint64_t{2} * 256 * 128);
}

TEST(Atlas, isBoundedWhereATriangleRepeatsItsImageAHundredTimes) {
  std::vector<TriangleTexture> triangles = {{1, {glm::vec2(0, 0), glm::vec2(100, 0), glm::vec2(0, 100)}},
                                            {2, {glm::vec2(0.1f), glm::vec2(0.2f, 0.1f), glm::vec2(0.1f, 0.2f)}}};
  WaveSampler sampler(TextureWrap::repeat);
  const std::optional<Atlas> atlas = atlasOf(triangles, sampler);
  ASSERT_TRUE(atlas.has_value());
  EXPECT_LE(std::max(atlas->image.width, atlas->image.height), kMaxTextureEdge);
  // The small chart keeps the resolution of its image.
  const glm::vec2 a = unpackedCoordinates(atlas->coordinates[1][0]), b = unpackedCoordinates(atlas->coordinates[1][1]);
  EXPECT_NEAR((b.x - a.x) * static_cast<float>(atlas->image.width), 25.6f, 0.1f);
  // Of numbers that are none, something.
  triangles[0].coordinates[1] = glm::vec2(INFINITY, -1e30f);
  triangles[0].coordinates[2] = glm::vec2(NAN, 1e30f);
  EXPECT_TRUE(atlasOf(triangles, sampler).has_value());
}

TEST(Atlas, isNoneWithoutAReadableTexture) {
  WaveSampler sampler(TextureWrap::repeat);
  const std::vector<TriangleTexture> triangles = {{7, {}}, {kNoTexture, {}}};
  EXPECT_FALSE(atlasOf(triangles, sampler).has_value());
}

TEST(Atlas, levelsAreMeansOfThoseBefore) {
  std::mt19937 random(3);
  WaveSampler sampler(TextureWrap::repeat);
  const TexturePage image = atlasOf(randomTriangles(random, 30, 3, 0.2f), sampler)->image;
  EXPECT_GE(image.levelCount, 4u);
  for (uint32_t level = 1; level < image.levelCount; ++level) {
    const size_t width = image.width >> level, before = 2 * width;
    for (size_t i = 0; i < image.levels[level].size(); i += 97) {
      const size_t x = i / 3 % width, y = i / 3 / width, channel = i % 3;
      int sum = 0;
      for (size_t part = 0; part < 4; ++part)
        sum += image.levels[level - 1][3 * ((2 * y + part / 2) * before + 2 * x + part % 2) + channel];
      ASSERT_NEAR(image.levels[level][i], sum / 4.0, 0.5) << level << " " << i;
    }
  }
}

TEST(Packing, placesRectanglesWithoutOverlapOrSaysThatTheyDoNotFit) {
  for (uint32_t seed = 0; seed < 20; ++seed) {
    SCOPED_TRACE(seed);
    std::mt19937 random(seed);
    std::vector<glm::uvec2> sizes;
    for (uint32_t i = 0; i < 1 + seed * 4; ++i) sizes.emplace_back(1 + random() % 9, 1 + random() % 9);
    const auto packing = packed(sizes, 64);
    ASSERT_TRUE(packing.has_value());
    std::vector<int> used(size_t{packing->size.x} * packing->size.y);
    for (size_t i = 0; i < sizes.size(); ++i)
      for (uint32_t y = 0; y < sizes[i].y; ++y)
        for (uint32_t x = 0; x < sizes[i].x; ++x)
          ASSERT_EQ(used.at((packing->places[i].y + y) * size_t{packing->size.x} + packing->places[i].x + x)++, 0);
    EXPECT_EQ(packed(sizes, 64)->places, packing->places);
  }
  EXPECT_FALSE(packed(std::vector<glm::uvec2>(3, glm::uvec2(5)), 8).has_value());
  EXPECT_FALSE(packed(std::vector<glm::uvec2>{glm::uvec2(9, 1)}, 8).has_value());
}

}  // namespace
}  // namespace farcell
