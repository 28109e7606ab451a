// Textures as the baker sees them: functions of a place and a footprint.
#include <functional>
#include <random>

#include <gtest/gtest.h>

#include "tests/preprocess/bake/bake_scenes.h"

namespace farcell {
namespace {

using namespace test;

class FunctionSampler final : public TextureSampler {
 public:
  explicit FunctionSampler(std::function<glm::vec3(const TextureLookup&)> colour) : colour_(std::move(colour)) {}
  glm::vec4 sample(const TextureLookup& lookup) override { return glm::vec4(colour_(lookup), 1); }
  const std::optional<Error>& failure() const override { return failure_; }

 private:
  std::function<glm::vec3(const TextureLookup&)> colour_;
  std::optional<Error> failure_;
};

void addTextured(CellSoup& soup, const glm::vec3 (&p)[3], const glm::vec2 (&at)[3], uint32_t texture,
                 uint32_t colour = 0xffffff) {
  addTriangle(soup, p[0], p[1], p[2], colour);
  soup.textures.push_back(texture);
  for (size_t k = 0; k < 3; ++k) {
    soup.u[k].push_back(at[k].x);
    soup.v[k].push_back(at[k].y);
  }
}

// The square [-.9, .9]^2 in the plane z = 0 as pieces x pieces x 2 triangles, u and v from 0 to 1.
CellSoup texturedSquare(int pieces, uint32_t colour = 0xffffff) {
  CellSoup soup;
  const auto place = [&](int i, int j) { return glm::vec2(float(i), float(j)) / float(pieces); };
  const auto position = [&](glm::vec2 at) { return glm::vec3(at * 1.8f - 0.9f, 0); };
  for (int i = 0; i < pieces; ++i) {
    for (int j = 0; j < pieces; ++j) {
      const glm::vec2 a = place(i, j), b = place(i + 1, j), c = place(i + 1, j + 1), d = place(i, j + 1);
      addTextured(soup, {position(a), position(b), position(c)}, {a, b, c}, 0, colour);
      addTextured(soup, {position(a), position(c), position(d)}, {a, c, d}, 0, colour);
    }
  }
  return soup;
}

// Light from straight above the square: a lit colour is the albedo.
BakeSettings settingsOf(int imageSize, int samples) { return {imageSize, samples, glm::vec3(0, 0, 1), false}; }

const ViewFrame kFromAbove = viewFrame(glm::dvec3(0, 0, 1));

BakedPair bakeTextured(const CellSoup& soup, const ViewFrame& frame, const BakeSettings& settings,
                       TextureSampler& textures) {
  ViewBaker baker(settings, &textures);
  BakedPair pair;
  baker.begin(frame);
  baker.add(soup);
  baker.finish(pair.view, pair.antipode);
  return pair;
}

glm::vec2 textureAt(const ViewFrame& frame, glm::dvec2 image) {
  const glm::dvec3 p = image.x * frame.right + image.y * frame.up;  // of the plane z = 0 seen from above
  return glm::vec2(glm::dvec2(p.x, p.y) / 1.8 + 0.5);
}

TEST(BakedTexture, EveryTexelShowsItsPlaceOnTheTexture) {
  FunctionSampler places([](const TextureLookup& lookup) { return glm::vec3(lookup.at, 0.25f); });
  const int size = 64;
  for (const int pieces : {1, 7, 100}) {  // triangles of many samples, of a few, below one
    const BakedPair pair = bakeTextured(texturedSquare(pieces), kFromAbove, settingsOf(size, 16), places);
    int seen = 0;
    for (int y = 0; y < size; ++y) {
      for (int x = 0; x < size; ++x) {
        const std::array<float, 4> texel = rgbaAt(pair.view, x, y);
        if (texel[3] < 1) continue;
        ++seen;
        const double t = texelSize(size);
        const glm::vec2 at =
            textureAt(kFromAbove, glm::dvec2((x + .5) * t - kViewHalfExtent, (y + .5) * t - kViewHalfExtent));
        EXPECT_NEAR(texel[0], at.x, 0.002f);
        EXPECT_NEAR(texel[1], at.y, 0.002f);
        EXPECT_NEAR(texel[2], 0.25f, 0.002f);
      }
    }
    EXPECT_GT(seen, 800);
  }
}

TEST(BakedTexture, TheFootprintIsThatOfASample) {
  const int size = 64, samples = 16;
  double leastArea = 1e9, mostArea = 0;
  FunctionSampler footprints([&](const TextureLookup& lookup) {
    const double area = std::abs(lookup.alongX.x * lookup.alongY.y - lookup.alongX.y * lookup.alongY.x);
    leastArea = std::min(leastArea, area);
    mostArea = std::max(mostArea, area);
    return glm::vec3(1);
  });
  for (const glm::dvec3 toward : {glm::dvec3(0, 0, 1), glm::dvec3(0, .6, .8), glm::dvec3(.48, -.64, .6)}) {
    leastArea = 1e9;
    mostArea = 0;
    bakeTextured(texturedSquare(3), viewFrame(toward), settingsOf(size, samples), footprints);
    const double side = texelSize(size) / 4 / 1.8, expected = side * side / toward.z;
    EXPECT_NEAR(leastArea / expected, 1, 1e-3);
    EXPECT_NEAR(mostArea / expected, 1, 1e-3);
  }
}

TEST(BakedTexture, ItIsMultipliedWithTheVertexColours) {
  FunctionSampler half([](const TextureLookup&) { return glm::vec3(0.5f, 1, 0.25f); });
  const BakedPair pair = bakeTextured(texturedSquare(5, 0x3264c8), kFromAbove, settingsOf(32, 4), half);
  const std::array<float, 4> texel = rgbaAt(pair.view, 16, 16);
  EXPECT_NEAR(texel[0], 200 * 0.5f / 255, 0.002f);
  EXPECT_NEAR(texel[1], 100 / 255.0f, 0.002f);
  EXPECT_NEAR(texel[2], 50 * 0.25f / 255, 0.002f);
}

CellSoup randomTextured(uint32_t seed, int count) {
  CellSoup soup = randomSoup(seed, count);
  std::mt19937 random(seed);
  std::uniform_real_distribution<float> place(-2, 2);
  for (size_t i = 0; i < soup.size(); ++i) {
    soup.textures.push_back(i % 3 == 0 ? kNoTexture : static_cast<uint32_t>(i % 3));
    for (size_t k = 0; k < 3; ++k) {
      soup.u[k].push_back(place(random));
      soup.v[k].push_back(place(random));
    }
  }
  return soup;
}

// Like PyramidSampler: sides count by their squares and products only.
FunctionSampler wild() {
  return FunctionSampler([](const TextureLookup& lookup) {
    const float area = std::abs(lookup.alongX.x * lookup.alongY.y - lookup.alongX.y * lookup.alongY.x);
    const float wave = 0.5f + 0.5f * std::sin(20 * lookup.at.x + float(lookup.texture));
    return glm::vec3(wave, std::abs(std::sin(9 * lookup.at.y)), 1 / (1 + area));
  });
}

TEST(BakedTexture, TheAntipodeIsBitForBitTheViewFromThere) {
  FunctionSampler textures = wild();
  const CellSoup soup = randomTextured(21, 400);
  const glm::dvec3 toward = glm::normalize(glm::dvec3(.3, -.5, .8));
  const BakedPair pair = bakeTextured(soup, viewFrame(toward), settingsOf(64, 16), textures);
  const BakedPair other = bakeTextured(soup, viewFrame(-toward), settingsOf(64, 16), textures);
  EXPECT_TRUE(sameView(pair.antipode, other.view));
  EXPECT_TRUE(sameView(pair.view, other.antipode));
}

CellSoup partOf(const CellSoup& soup, size_t begin, size_t end) {
  CellSoup result = part(soup, begin, end);
  const auto first = ptrdiff_t(begin), last = ptrdiff_t(end);
  result.textures.assign(soup.textures.begin() + first, soup.textures.begin() + last);
  for (size_t k = 0; k < 3; ++k) {
    result.u[k].assign(soup.u[k].begin() + first, soup.u[k].begin() + last);
    result.v[k].assign(soup.v[k].begin() + first, soup.v[k].begin() + last);
  }
  return result;
}

// Chunks without any texture leave the coordinates out.
TEST(BakedTexture, ChunksChangeNothing) {
  FunctionSampler textures = wild();
  const CellSoup soup = randomTextured(22, 600);
  const ViewFrame frame = viewFrame(glm::normalize(glm::dvec3(-.2, .4, .6)));
  const BakedPair whole = bakeTextured(soup, frame, settingsOf(64, 16), textures);
  ViewBaker baker(settingsOf(64, 16), &textures);
  baker.begin(frame);
  for (size_t at = 0; at < soup.size(); ++at) {
    CellSoup chunk = partOf(soup, at, at + 1);
    if (chunk.textures[0] == kNoTexture) chunk = part(soup, at, at + 1);
    baker.add(chunk);
  }
  BakedPair parts;
  baker.finish(parts.view, parts.antipode);
  EXPECT_TRUE(sameView(whole.view, parts.view));
  EXPECT_TRUE(sameView(whole.antipode, parts.antipode));
}

}  // namespace
}  // namespace farcell
