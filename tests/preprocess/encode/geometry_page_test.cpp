#include "preprocess/encode/geometry_page.h"

#include <gtest/gtest.h>

namespace farcell {
namespace {

TEST(GeometryPageOf, SharesVerticesThatAgreeInEverything) {
  const GridTriangle a{{GridPoint(8, 8, 8), GridPoint(9, 8, 8), GridPoint(8, 9, 8)}, {1, 1, 1}, {5, 5, 5}};
  GridTriangle b = a;
  b.corners[0] = GridPoint(9, 9, 8);
  b.colours[1] = 2;  // so this corner is a vertex of its own
  Model model;
  model.hasColours = model.hasNormals = true;
  const std::vector<GridTriangle> triangles = {a, b};
  const GeometryPage page = geometryPage(triangles, GridPoint(8, 8, 8), model);
  EXPECT_EQ(page.positions.size(), 5u);
  EXPECT_EQ(page.indices, (std::vector<uint32_t>{0, 1, 2, 3, 4, 2}));
  EXPECT_EQ(page.positions[1], glm::uvec3(1, 0, 0));
  EXPECT_EQ(page.colours[4], 2u);
}

TEST(GeometryPageOf, LeavesOutWhatTheModelDoesNotHave) {
  const GridTriangle a{{GridPoint(0), GridPoint(1, 0, 0), GridPoint(0, 1, 0)}, {1, 1, 1}, {5, 5, 5}};
  const GeometryPage page = geometryPage(std::vector{a}, GridPoint(0), Model{});
  EXPECT_TRUE(page.colours.empty());
  EXPECT_TRUE(page.normals.empty());
}

}  // namespace
}  // namespace farcell
