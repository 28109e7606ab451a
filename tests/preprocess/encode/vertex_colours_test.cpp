#include "preprocess/encode/vertex_colours.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>

namespace farcell {
namespace {

// Red is the middle of the footprint, green and blue its extent along u and v.
class PlaceSampler final : public TextureSampler {
 public:
  glm::vec4 sample(const TextureLookup& lookup) override {
    const auto extent = [&](int axis) { return std::abs(lookup.alongX[axis]) + std::abs(lookup.alongY[axis]); };
    return glm::vec4(lookup.at.x, extent(0), extent(1), 1);
  }
  const std::optional<Error>& failure() const override { return failure_; }

 private:
  std::optional<Error> failure_;
};

// A flat grid of edge x edge squares, each of two triangles; u from 0 to 1 along x, v along y.
GridTriangles gridOf(int edge, uint32_t colour) {
  GridTriangles list;
  const auto add = [&](std::array<glm::ivec2, 3> corners) {
    GridTriangle triangle{};
    TriangleTexture texture;
    texture.texture = 0;
    for (size_t k = 0; k < 3; ++k) {
      triangle.corners[k] = GridPoint(corners[k].x * 100, corners[k].y * 100, 0);
      triangle.colours[k] = colour;
      texture.coordinates[k] = glm::vec2(corners[k]) / float(edge);
    }
    list.add(triangle, texture);
  };
  for (int x = 0; x < edge; ++x) {
    for (int y = 0; y < edge; ++y) {
      const glm::ivec2 at(x, y);
      add({at, at + glm::ivec2(1, 0), at + glm::ivec2(1, 1)});
      add({at, at + glm::ivec2(1, 1), at + glm::ivec2(0, 1)});
    }
  }
  return list;
}

TEST(VertexColours, AVertexThatTrianglesShareHasOneColour) {
  PlaceSampler textures;
  std::map<std::pair<int, int>, uint32_t> colourAt;
  for (const GridTriangle& triangle : withTexturesAsColours(gridOf(10, 0xffffff), &textures)) {
    for (size_t k = 0; k < 3; ++k) {
      const auto [entry, added] =
          colourAt.try_emplace({triangle.corners[k].x, triangle.corners[k].y}, triangle.colours[k]);
      EXPECT_EQ(entry->second, triangle.colours[k]);
    }
  }
  EXPECT_EQ(colourAt.size(), 121u);
}

TEST(VertexColours, InsideAGridAGradientIsItself) {
  PlaceSampler textures;
  for (const GridTriangle& triangle : withTexturesAsColours(gridOf(10, 0xffffff), &textures)) {
    for (size_t k = 0; k < 3; ++k) {
      const GridPoint corner = triangle.corners[k];
      const bool inside = corner.x > 0 && corner.x < 1000 && corner.y > 0 && corner.y < 1000;
      if (!inside) continue;
      EXPECT_NEAR(triangle.colours[k] & 255, 255 * corner.x / 1000.0, 0.51);
    }
  }
}

TEST(VertexColours, TheFootprintIsSomeHalfATriangleAndWithinIt) {
  PlaceSampler textures;
  for (const GridTriangle& triangle : withTexturesAsColours(gridOf(4, 0xffffff), &textures)) {
    for (size_t k = 0; k < 3; ++k) {
      for (const int shift : {8, 16}) EXPECT_NEAR(triangle.colours[k] >> shift & 255, 255 * 0.25 * 0.5, 20);
      // At the borders, where triangles lie on one side only, it is drawn inward.
      EXPECT_NEAR(triangle.colours[k] & 255, 255 * triangle.corners[k].x / 400.0, 255 * 0.25 / 4 + 1);
    }
  }
}

TEST(VertexColours, TexturesMultiplyColoursAndLeaveOthersAlone) {
  class Half final : public TextureSampler {
   public:
    glm::vec4 sample(const TextureLookup&) override { return glm::vec4(0.5f, 1, 0, 1); }
    const std::optional<Error>& failure() const override { return failure_; }

   private:
    std::optional<Error> failure_;
  } half;
  GridTriangles list = gridOf(1, 0x3264c8);
  list.add(list.triangles[0], {});
  const std::vector<GridTriangle> coloured = withTexturesAsColours(std::move(list), &half);
  ASSERT_EQ(coloured.size(), 3u);
  EXPECT_EQ(coloured[0].colours[0], 0x006464u);
  EXPECT_EQ(coloured[2].colours[0], 0x3264c8u);
  EXPECT_EQ(withTexturesAsColours(GridTriangles{{coloured[2]}, {}}, nullptr)[0].colours[0], 0x3264c8u);
}

}  // namespace
}  // namespace farcell
