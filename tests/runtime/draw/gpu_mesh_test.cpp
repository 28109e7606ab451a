#include "runtime/draw/gpu_mesh.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <glm/geometric.hpp>
#include <random>

#include "cache/schema/model.h"
#include "shaders/shared/shading.h"

namespace farcell {
namespace {

glm::vec3 decoded(uint32_t packed) {
  const auto snorm = [](uint32_t bits) { return static_cast<float>(static_cast<int16_t>(bits)) / 32767.0f; };
  return shared::unitFromOctahedral({snorm(packed & 0xffff), snorm(packed >> 16)});
}

// A soup of triangles over few shared vertices, so that many triangles compete for them.
GeometryPage sharedSoup(unsigned seed, uint32_t vertices, uint32_t triangles) {
  std::mt19937 random(seed);
  std::uniform_int_distribution<uint32_t> coordinate(0, 1u << 24), index(0, vertices - 1);
  GeometryPage page;
  for (uint32_t i = 0; i < vertices; ++i) {
    page.positions.push_back({coordinate(random), coordinate(random), coordinate(random)});
    page.colours.push_back(random() & 0xffffff);
  }
  for (uint32_t i = 0; i < 3 * triangles; ++i) page.indices.push_back(index(random));
  return page;
}

std::array<GridPoint, 3> sortedCorners(std::array<GridPoint, 3> corners) {
  std::sort(corners.begin(), corners.end(),
            [](GridPoint a, GridPoint b) { return std::tie(a.x, a.y, a.z) < std::tie(b.x, b.y, b.z); });
  return corners;
}

TEST(GpuMesh, everyFlatTriangleKeepsItsCornersAndColoursAndEndsInItsNormal) {
  const unsigned seed = 9;
  SCOPED_TRACE(fmt::format("seed {}", seed));
  const GeometryPage page = sharedSoup(seed, 40, 300);
  const GridPoint origin(5, -7, 1 << 20);
  const GpuMesh mesh = makeGpuMesh(page, origin);
  ASSERT_EQ(mesh.indices.size(), page.indices.size());
  EXPECT_LE(mesh.vertices.size(), page.positions.size() + 300);
  for (size_t t = 0; t < mesh.indices.size(); t += 3) {
    std::array<GridPoint, 3> expected, found;
    for (size_t k = 0; k < 3; ++k) {
      expected[k] = origin + GridPoint(page.positions[page.indices[t + k]]);
      found[k] = mesh.vertices[mesh.indices[t + k]].position;
    }
    ASSERT_EQ(sortedCorners(expected), sortedCorners(found));
    const glm::vec3 normal = decoded(mesh.vertices[mesh.indices[t + 2]].normal);
    ASSERT_GT(std::abs(glm::dot(normal, faceNormal(expected[0], expected[1], expected[2]))), 0.999999f);
    for (size_t k = 0; k < 3; ++k) {
      const GpuVertex& vertex = mesh.vertices[mesh.indices[t + k]];
      const bool known = std::any_of(page.indices.begin() + static_cast<ptrdiff_t>(t),
                                     page.indices.begin() + static_cast<ptrdiff_t>(t) + 3, [&](uint32_t i) {
                                       return vertex.position == origin + GridPoint(page.positions[i]) &&
                                              vertex.colour == (page.colours[i] | 0xff000000u);
                                     });
      ASSERT_TRUE(known);
    }
  }
}

TEST(GpuMesh, aTriangleThatSaysWhatItShowsEndsInIt) {
  const unsigned seed = 10;
  SCOPED_TRACE(fmt::format("seed {}", seed));
  GeometryPage page = sharedSoup(seed, 40, 300);
  std::mt19937 random(seed);
  for (size_t t = 0; t < 300; ++t) page.shown.push_back(static_cast<uint32_t>(random()) & 0xffffff);
  const GpuMesh mesh = makeGpuMesh(page, GridPoint(0));
  ASSERT_EQ(mesh.indices.size(), page.indices.size());
  for (size_t t = 0; t < 300; ++t) {
    std::array<GridPoint, 3> expected, found;
    for (size_t k = 0; k < 3; ++k) {
      expected[k] = GridPoint(page.positions[page.indices[3 * t + k]]);
      found[k] = mesh.vertices[mesh.indices[3 * t + k]].position;
    }
    ASSERT_EQ(sortedCorners(expected), sortedCorners(found));
    // Without the opaque bits: that is how the shader knows it.
    ASSERT_EQ(mesh.vertices[mesh.indices[3 * t + 2]].colour, page.shown[t]);
  }
}

TEST(GpuMesh, aStripOfFlatTrianglesNeedsNoCopies) {
  GeometryPage page;
  for (uint32_t i = 0; i < 12; ++i) page.positions.push_back({i, i % 2 * 10, i * i});
  for (uint32_t i = 0; i + 2 < 12; ++i) page.indices.insert(page.indices.end(), {i, i + 1, i + 2});
  EXPECT_EQ(makeGpuMesh(page, GridPoint(0)).vertices.size(), 12u);
}

TEST(GpuMesh, fileNormalsAndOrderAreKept) {
  const GeometryPage page{.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, .normals = {1, 2, 3}, .indices = {0, 1, 2}};
  const GpuMesh mesh = makeGpuMesh(page, GridPoint(0));
  EXPECT_EQ(mesh.indices, page.indices);
  for (uint32_t i = 0; i < 3; ++i) EXPECT_EQ(mesh.vertices[i].normal, i + 1);
  EXPECT_EQ(mesh.vertices[0].colour & 255, kDefaultAlbedo[0]);
  EXPECT_EQ(mesh.vertices[0].colour >> 16 & 255, kDefaultAlbedo[2]);
}

TEST(GpuMesh, faceNormalsAreExactForTheLargestAndTheThinnestTriangles) {
  const int side = 1 << 24;
  EXPECT_EQ(faceNormal({0, 0, 0}, {side, 0, 0}, {0, side, 0}), glm::vec3(0, 0, 1));
  // A sliver one step wide over the whole model: floats would lose its direction.
  const glm::vec3 sliver = faceNormal({0, 0, 0}, {side, side, side}, {side, side, side - 1});
  EXPECT_LT(glm::length(sliver - glm::normalize(glm::vec3(-1, 1, 0))), 1e-6f);
  EXPECT_EQ(faceNormal({1, 1, 1}, {1, 1, 1}, {2, 2, 2}), glm::vec3(0, 0, 1));
}

}  // namespace
}  // namespace farcell
