// Holes and transparency in views, against what blending layers in order gives.
#include <functional>
#include <random>

#include <gtest/gtest.h>

#include "tests/preprocess/bake/bake_scenes.h"

namespace farcell {
namespace {

using namespace test;

// Texture i is `looks[i]` with a surface of `kinds[i]`.
class Looks final : public TextureSampler {
 public:
  using Look = std::function<glm::vec4(const TextureLookup&)>;
  void add(const SurfaceKind& kind, Look look) {
    kinds_.push_back(kind);
    looks_.push_back(std::move(look));
  }
  void add(const SurfaceKind& kind, glm::vec4 colour) {
    add(kind, [=](const TextureLookup&) { return colour; });
  }
  glm::vec4 sample(const TextureLookup& lookup) override { return looks_[lookup.texture](lookup); }
  SurfaceKind surface(uint32_t texture) const override { return kinds_[texture]; }
  const std::optional<Error>& failure() const override { return failure_; }

 private:
  std::vector<SurfaceKind> kinds_;
  std::vector<Look> looks_;
  std::optional<Error> failure_;
};

constexpr SurfaceKind kBlend{.alpha = AlphaMode::blend};
constexpr SurfaceKind kMask{.alpha = AlphaMode::mask};
constexpr SurfaceKind kFrontOnly{.hasImage = false, .doubleSided = false};

// The square [-.9, .9]^2 at height z, its front upwards, of pieces x pieces x 2 triangles; u and v from 0 to 1.
void addSquare(CellSoup& soup, uint32_t texture, float z, int pieces = 1) {
  const auto add = [&](std::array<glm::ivec2, 3> corners) {
    std::array<glm::vec2, 3> at;
    for (size_t k = 0; k < 3; ++k) at[k] = glm::vec2(corners[k]) / static_cast<float>(pieces);
    const auto position = [&](size_t k) { return glm::vec3(at[k] * 1.8f - 0.9f, z); };
    addTriangle(soup, position(0), position(1), position(2));
    soup.textures.push_back(texture);
    for (size_t k = 0; k < 3; ++k) {
      soup.u[k].push_back(at[k].x);
      soup.v[k].push_back(at[k].y);
    }
  };
  for (int i = 0; i < pieces; ++i) {
    for (int j = 0; j < pieces; ++j) {
      const glm::ivec2 a(i, j);
      add({a, a + glm::ivec2(1, 0), a + glm::ivec2(1, 1)});
      add({a, a + glm::ivec2(1, 1), a + glm::ivec2(0, 1)});
    }
  }
}

BakedPair bake(const CellSoup& soup, glm::dvec3 toward, TextureSampler& textures, int samples = 16) {
  // Light from straight above the squares: a lit colour is the albedo.
  ViewBaker baker({64, samples, glm::vec3(0, 0, 1), false}, &textures);
  BakedPair pair;
  baker.begin(viewFrame(toward));
  baker.add(soup);
  baker.finish(pair.view, pair.antipode);
  return pair;
}

struct Sum {
  double coverage = 0, squares = 0;
  glm::dvec3 colour{0};
  double texels = 0;
  double deviation() const { return std::sqrt(squares / texels - coverage / texels * coverage / texels); }
};

// Of the texels whose middle third `inside` holds.
Sum sumOf(const BakedView& view, const BakedView& mould) {
  Sum sum;
  for (int y = 1; y < 63; ++y) {
    for (int x = 1; x < 63; ++x) {
      bool inside = true;
      for (int dy = -1; dy <= 1; ++dy)
        for (int dx = -1; dx <= 1; ++dx) inside = inside && rgbaAt(mould, x + dx, y + dy)[3] == 1;
      if (!inside) continue;
      const std::array<float, 4> texel = rgbaAt(view, x, y);
      sum.texels += 1;
      sum.coverage += texel[3];
      sum.squares += texel[3] * texel[3];
      sum.colour += glm::dvec3(texel[0], texel[1], texel[2]);
    }
  }
  return sum;
}

const std::vector<glm::dvec3> kDirections = {
    {0, 0, 1}, {0, .6, .8}, {.48, -.64, .6}, {-.36, .48, .8}, {.1, .2, -.97468}};

TEST(BakedAlpha, OneLayerHasItsAlphaInEveryTexel) {
  CellSoup whole;
  addSquare(whole, 0, 0);
  for (const int pieces : {1, 30, 200}) {  // triangles of many samples, of some, below one
    for (const float alpha : {0.3f, 0.5f, 0.85f}) {
      Looks textures, opaque;
      textures.add(kBlend, glm::vec4(1, .5f, 0, alpha));
      opaque.add({}, glm::vec4(1));
      CellSoup soup;
      addSquare(soup, 0, 0, pieces);
      for (const glm::dvec3 toward : kDirections) {
        const Sum sum = sumOf(bake(soup, toward, textures).view, bake(whole, toward, opaque).view);
        ASSERT_GT(sum.texels, 300);
        const double coverage = sum.coverage / sum.texels;
        EXPECT_NEAR(coverage, alpha, 4 * 0.5 / 16 / std::sqrt(sum.texels)) << pieces;
        EXPECT_LE(sum.deviation(), 0.6 / 16);  // chance alone: sqrt(alpha (1 - alpha) / 16), .09 to .125
        for (int channel = 0; channel < 3; ++channel)
          EXPECT_NEAR(sum.colour[channel] / sum.coverage, (std::array{1., .5, 0.}[size_t(channel)]), 0.003);
      }
    }
  }
}

TEST(BakedAlpha, LayersShowWhatBlendingThemInOrderDoes) {
  const std::array<glm::dvec4, 4> layers = {glm::dvec4(1, 0, 0, .3), {0, 1, 0, .5}, {0, 0, 1, .4}, {1, 1, 0, .2}};
  for (const size_t count : {2u, 4u}) {
    Looks textures, opaque;
    opaque.add({}, glm::vec4(1));
    CellSoup soup, whole;
    addSquare(whole, 0, 0);
    for (size_t i = 0; i < count; ++i) {
      textures.add(kBlend, glm::vec4(layers[i]));
      addSquare(soup, static_cast<uint32_t>(i), 0.3f - 0.05f * static_cast<float>(i));
    }
    for (const bool fromAbove : {true, false}) {
      glm::dvec3 colour(0);
      double seen = 1;
      for (size_t i = 0; i < count; ++i) {
        const glm::dvec4& layer = layers[fromAbove ? i : count - 1 - i];
        colour += seen * layer.w * glm::dvec3(layer);
        seen *= 1 - layer.w;
      }
      const BakedPair pair = bake(soup, {0, 0, 1}, textures), mould = bake(whole, {0, 0, 1}, opaque);
      const Sum sum = sumOf(fromAbove ? pair.view : pair.antipode, fromAbove ? mould.view : mould.antipode);
      const double bound = 4 * 0.125 / std::sqrt(sum.texels);  // of samples by chance, four deviations
      EXPECT_NEAR(sum.coverage / sum.texels, 1 - seen, bound);
      for (int channel = 0; channel < 3; ++channel)
        EXPECT_NEAR(sum.colour[channel] / sum.texels, colour[channel], bound) << channel;
    }
  }
}

TEST(BakedAlpha, ASurfaceBehindIsSeenThroughHolesOnly) {
  Looks textures;
  textures.add(kMask, [](const TextureLookup& at) { return at.at.x < 0.5f ? glm::vec4(1, 0, 0, 1) : glm::vec4(0); });
  textures.add({}, glm::vec4(0, 1, 0, 1));
  CellSoup soup;
  addSquare(soup, 0, 0.2f, 20);
  addSquare(soup, 1, -0.2f, 3);
  const BakedPair pair = bake(soup, {0, 0, 1}, textures);
  const ViewFrame frame = viewFrame(glm::dvec3(0, 0, 1));
  int red = 0, green = 0;
  for (int y = 0; y < 64; ++y) {
    for (int x = 0; x < 64; ++x) {
      const std::array<float, 4> texel = rgbaAt(pair.view, x, y);
      if (texel[3] < 1) continue;
      const double t = texelSize(64);
      const glm::dvec3 at =
          ((x + .5) * t - kViewHalfExtent) * frame.right + ((y + .5) * t - kViewHalfExtent) * frame.up;
      if (std::abs(at.x) < t) continue;
      EXPECT_NEAR(texel[0], at.x < 0 ? 1 : 0, 1e-3);
      EXPECT_NEAR(texel[1], at.x < 0 ? 0 : 1, 1e-3);
      ++(at.x < 0 ? red : green);
      EXPECT_EQ(rgbaAt(pair.antipode, 63 - x, y)[1], 1) << "from below the whole one hides the other";
    }
  }
  EXPECT_GT(red, 400);
  EXPECT_GT(green, 400);
}

TEST(BakedAlpha, OneSideIsSeenFromItsFrontOnly) {
  Looks textures, whole;
  textures.add(kFrontOnly, glm::vec4(1));
  whole.add({}, glm::vec4(1));
  for (const int pieces : {1, 40}) {
    CellSoup soup;
    addSquare(soup, 0, 0, pieces);
    for (const glm::dvec3 toward : kDirections) {
      const BakedPair one = bake(soup, toward, textures), both = bake(soup, toward, whole);
      const bool above = toward.z > 0;
      EXPECT_EQ((above ? one.antipode : one.view).width, 0);
      const BakedView &seen = above ? one.view : one.antipode, &expected = above ? both.view : both.antipode;
      EXPECT_EQ(seen.depth, expected.depth);
      ASSERT_EQ(seen.rgba.size(), expected.rgba.size());
      for (size_t i = 0; i < seen.rgba.size(); ++i) ASSERT_NEAR(seen.rgba[i], expected.rgba[i], 1e-3);
    }
  }
}

CellSoup randomTransparent(uint32_t seed) {
  CellSoup soup = randomSoup(seed, 600);
  std::mt19937 random(seed);
  std::uniform_real_distribution<float> place(-2, 2);
  for (size_t i = 0; i < soup.size(); ++i) {
    soup.textures.push_back(i % 4 == 0 ? kNoTexture : static_cast<uint32_t>(i % 4 - 1));
    for (size_t k = 0; k < 3; ++k) {
      soup.u[k].push_back(place(random));
      soup.v[k].push_back(place(random));
    }
  }
  return soup;
}

void addWild(Looks& textures) {
  const auto wave = [](const TextureLookup& at) {
    return glm::vec4(0.5f, 1, 0, 0.5f + 0.5f * std::sin(9 * at.at.x + 7 * at.at.y));
  };
  textures.add(kBlend, wave);
  textures.add({.doubleSided = false, .alpha = AlphaMode::blend}, wave);
  textures.add(kFrontOnly, glm::vec4(1));
}

TEST(BakedAlpha, TheAntipodeIsTheViewFromThere) {
  Looks textures;
  addWild(textures);
  for (const uint32_t seed : {1u, 2u, 3u}) {
    const CellSoup soup = randomTransparent(seed);
    const glm::dvec3 toward = glm::normalize(glm::dvec3(.3 * seed, -.5, .4));
    const BakedPair here = bake(soup, toward, textures), there = bake(soup, -toward, textures);
    EXPECT_EQ(here.antipode.rgba, there.view.rgba);
    EXPECT_EQ(here.antipode.depth, there.view.depth);
    EXPECT_EQ(here.view.rgba, there.antipode.rgba);
  }
}

TEST(BakedAlpha, ChunksAndOrderOfTrianglesChangeNothing) {
  Looks textures;
  addWild(textures);
  const CellSoup soup = randomTransparent(5);
  const BakedPair whole = bake(soup, {0, .6, .8}, textures);
  ViewBaker baker({64, 16, glm::vec3(0, 0, 1), false}, &textures);
  BakedPair parts;
  baker.begin(viewFrame(glm::dvec3(0, .6, .8)));
  for (size_t begin = 0; begin < soup.size(); begin += 37) {
    const size_t end = std::min(soup.size(), begin + 37);
    CellSoup chunk = part(soup, begin, end);
    const auto cut = [&](const auto& from, auto& to) {
      to.assign(from.begin() + ptrdiff_t(begin), from.begin() + ptrdiff_t(end));
    };
    cut(soup.textures, chunk.textures);
    for (size_t k = 0; k < 3; ++k) {
      cut(soup.u[k], chunk.u[k]);
      cut(soup.v[k], chunk.v[k]);
    }
    baker.add(chunk);
  }
  baker.finish(parts.view, parts.antipode);
  EXPECT_EQ(whole.view.rgba, parts.view.rgba);
  EXPECT_EQ(whole.antipode.rgba, parts.antipode.rgba);
}

TEST(BakedAlpha, AllOrNothingIsExact) {
  Looks textures, opaque;
  textures.add(kBlend, glm::vec4(.5f, .5f, .5f, 1));
  textures.add(kBlend, glm::vec4(0));
  opaque.add({}, glm::vec4(.5f, .5f, .5f, 1));
  CellSoup soup, single;
  addSquare(soup, 0, 0, 9);
  single = soup;
  addSquare(soup, 1, 0.5f, 9);
  for (const int samples : {1, 4, 16, 64}) {
    const BakedPair found = bake(soup, {0, .6, .8}, textures, samples),
                    expected = bake(single, {0, .6, .8}, opaque, samples);
    EXPECT_EQ(found.view.rgba, expected.view.rgba);
    EXPECT_EQ(found.antipode.depth, expected.antipode.depth);
  }
}

}  // namespace
}  // namespace farcell
