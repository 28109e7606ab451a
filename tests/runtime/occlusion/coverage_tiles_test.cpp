#include "runtime/occlusion/coverage_tiles.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <random>
#include <vector>

namespace farcell {
namespace {

using Triangle = std::array<glm::dvec3, 3>;

constexpr int kWidth = 61, kHeight = 43;
const std::vector<glm::vec2> kOne = {{0.5f, 0.5f}};
const std::vector<glm::vec2> kFour = {{0.375f, 0.125f}, {0.875f, 0.375f}, {0.125f, 0.625f}, {0.625f, 0.875f}};

// The largest depth of the triangles at a point; 0: none. By barycentric coordinates.
double depthAt(const std::vector<Triangle>& triangles, double x, double y) {
  double best = 0;
  for (const Triangle& t : triangles) {
    const double area = (t[1].x - t[0].x) * (t[2].y - t[0].y) - (t[1].y - t[0].y) * (t[2].x - t[0].x);
    const double b = ((x - t[0].x) * (t[2].y - t[0].y) - (y - t[0].y) * (t[2].x - t[0].x)) / area;
    const double c = ((t[1].x - t[0].x) * (y - t[0].y) - (t[1].y - t[0].y) * (x - t[0].x)) / area;
    const double least = std::min({b, c, 1 - b - c});
    if (least * std::sqrt(std::abs(area)) < -1e-2) continue;  // as near to an edge as the tiles let pass, and more
    best = std::max(best, t[0].z + b * (t[1].z - t[0].z) + c * (t[2].z - t[0].z));
  }
  return best;
}

class CoverageTilesTest : public testing::TestWithParam<int> {
 protected:
  const std::vector<glm::vec2>& samples() const { return GetParam() == 1 ? kOne : kFour; }
};

TEST_P(CoverageTilesTest, whatIsCoveredIsNearerAtEverySample) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> part(0, 1);
  size_t covered = 0, open = 0;
  for (int round = 0; round < 60; ++round) {
    SCOPED_TRACE(fmt::format("seed 3, round {}", round));
    CoverageTiles tiles(kWidth, kHeight, samples());
    std::vector<Triangle> triangles;
    for (int i = 0; i < 1 + round % 12; ++i) {
      Triangle triangle;
      for (glm::dvec3& corner : triangle)
        corner = {(2 * part(random) - 0.5) * kWidth, (2 * part(random) - 0.5) * kHeight, 0.1 + part(random)};
      triangles.push_back(triangle);
      tiles.add(triangle, {});
    }
    for (int i = 0; i < 200; ++i) {
      const glm::dvec2 min(part(random) * kWidth, part(random) * kHeight);
      const glm::dvec2 max = min + glm::dvec2(part(random) * 12, part(random) * 12);
      const double depth = part(random);
      if (!tiles.covers(min, max, depth)) {
        ++open;
        continue;
      }
      ++covered;
      for (int y = static_cast<int>(min.y); y <= max.y && y < kHeight; ++y)
        for (int x = static_cast<int>(min.x); x <= max.x && x < kWidth; ++x)
          for (const glm::vec2& sample : samples()) {
            const double sx = x + static_cast<double>(sample.x), sy = y + static_cast<double>(sample.y);
            if (sx < min.x || sx > max.x || sy < min.y || sy > max.y) continue;
            ASSERT_GT(depthAt(triangles, sx, sy), depth * (1 - 1e-6)) << sx << " " << sy;
          }
    }
  }
  EXPECT_GT(covered, 500u);
  EXPECT_GT(open, 500u);
}

TEST_P(CoverageTilesTest, aRectangleOfManyTrianglesCoversAsOne) {
  // Joints of a random fan leave no sample open.
  std::mt19937 random(4);
  std::uniform_real_distribution<double> part(0.1, 0.9);
  for (int round = 0; round < 20; ++round) {
    CoverageTiles tiles(kWidth, kHeight, samples());
    const glm::dvec3 middle(part(random) * kWidth, part(random) * kHeight, 0.5);
    const std::array<glm::dvec3, 4> corners = {glm::dvec3(-9, -9, 0.5), glm::dvec3(kWidth + 9, -9, 0.5),
                                               glm::dvec3(kWidth + 9, kHeight + 9, 0.5),
                                               glm::dvec3(-9, kHeight + 9, 0.5)};
    for (size_t i = 0; i < 4; ++i) {
      EXPECT_FALSE(tiles.covers({0, 0}, {kWidth, kHeight}, 0.4));
      tiles.add({middle, corners[i], corners[(i + 1) % 4]}, {true, false, true});
    }
    EXPECT_TRUE(tiles.covers({0, 0}, {kWidth, kHeight}, 0.4)) << "seed 4, round " << round;
    EXPECT_FALSE(tiles.covers({0, 0}, {kWidth, kHeight}, 0.6));
  }
}

// Of two triangles, over the picture's height; sides: whether the left and right edges are inner.
void addColumn(CoverageTiles& tiles, double x0, double x1, bool sides) {
  const glm::dvec3 a(x0, -9, 0.5), b(x1, -9, 0.5), c(x1, kHeight + 9, 0.5), d(x0, kHeight + 9, 0.5);
  tiles.add({a, b, c}, {false, sides, true});
  tiles.add({a, c, d}, {true, false, sides});
}

TEST_P(CoverageTilesTest, samplesOnTheEdgeInsideAQuadAreCovered) {
  const glm::vec2 sample = samples()[0];  // the diagonal meets it in each pixel that it passes
  const double up = static_cast<double>(sample.y - sample.x);
  const glm::dvec3 a(-9, up - 9, 0.5), b(91, up - 9, 0.5), c(91, up + 91, 0.5), d(-9, up + 91, 0.5);
  for (const bool inner : {false, true}) {
    CoverageTiles tiles(kWidth, kHeight, samples());
    tiles.add({a, b, c}, {false, false, inner});
    tiles.add({d, a, c}, {false, inner, false});
    EXPECT_EQ(tiles.covers({8, 8}, {12, 12}, 0.4), inner);
    EXPECT_TRUE(tiles.covers({40, 8}, {44, 12}, 0.4));
  }
}

TEST_P(CoverageTilesTest, samplesOnASilhouetteAreNotCovered) {
  const double sample = 20 + static_cast<double>(samples()[0].x);
  for (const double off : {0.0, 1.0 / 256, -1.0 / 256, 1.0 / 64, -1.0 / 64})
    for (const bool inner : {false, true}) {
      CoverageTiles tiles(kWidth, kHeight, samples());
      addColumn(tiles, -9, sample + off, inner);
      addColumn(tiles, sample + off, kWidth + 9, inner);
      EXPECT_EQ(tiles.covers({20, 8}, {21, 12}, 0.4), inner || std::abs(off) > kSnapPixels) << off << " " << inner;
      EXPECT_TRUE(tiles.covers({5, 8}, {7, 12}, 0.4));
    }
}

TEST_P(CoverageTilesTest, whatLiesBesideThePictureIsCovered) {
  const CoverageTiles tiles(kWidth, kHeight, samples());
  EXPECT_TRUE(tiles.covers({-20, 5}, {-1, 9}, 1));
  EXPECT_FALSE(tiles.covers({-20, 5}, {1, 9}, 0.1));
}

TEST_P(CoverageTilesTest, degenerateTrianglesCoverNothing) {
  CoverageTiles tiles(kWidth, kHeight, samples());
  tiles.add({glm::dvec3(0, 0, 1), glm::dvec3(20, 20, 1), glm::dvec3(40, 40, 1)}, {});
  tiles.add({glm::dvec3(5, 5, 1), glm::dvec3(5, 5, 1), glm::dvec3(5, 9, 1)}, {});
  tiles.add({glm::dvec3(NAN, 5, 1), glm::dvec3(50, 5, 1), glm::dvec3(5, 9, 1)}, {});
  EXPECT_FALSE(tiles.covers({0, 0}, {40, 40}, 0.5));
}

INSTANTIATE_TEST_SUITE_P(Samples, CoverageTilesTest, testing::Values(1, 4));

}  // namespace
}  // namespace farcell
