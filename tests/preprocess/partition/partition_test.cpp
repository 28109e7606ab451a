#include "preprocess/partition/partition.h"

#include <gtest/gtest.h>

#include <cstring>
#include <glm/geometric.hpp>
#include <glm/vector_relational.hpp>
#include <limits>
#include <map>
#include <random>

#include "tests/support/temporary_directory.h"

namespace farcell {
namespace {

// A mesh in memory.
class MemoryMesh : public MeshReader {
 public:
  explicit MemoryMesh(std::vector<InputTriangle> triangles) : triangles_(std::move(triangles)) {
    info_.declaredTriangles = triangles_.size();
    for (const InputTriangle& triangle : triangles_)
      if (triangle.texture != kNoTexture) textures_.resize(std::max<size_t>(textures_.size(), triangle.texture + 1));
  }
  std::span<const TextureSource> textures() const override { return textures_; }
  const MeshInfo& info() const override { return info_; }
  std::vector<std::filesystem::path> files() const override { return {}; }
  Result<MeshCounts> forEachTriangle(const Sink& sink) override {
    FARCELL_TRY(sink(triangles_));
    return MeshCounts{triangles_.size(), {}};
  }

 private:
  MeshInfo info_;
  std::vector<InputTriangle> triangles_;
  std::vector<TextureSource> textures_;
};

InputTriangle inputTriangle(glm::dvec3 a, glm::dvec3 b, glm::dvec3 c) {
  InputTriangle triangle{};
  triangle.positions = {a, b, c};
  return triangle;
}

// A closed tetrahedral soup: `count` tetrahedra of sizes from largest / 1000 to `largest` in a box of `size` at
// `offset`.
std::vector<InputTriangle> tetrahedra(std::mt19937& random, int count, double size, glm::dvec3 offset,
                                      double largest = 1) {
  std::uniform_real_distribution<double> uniform(0, 1);
  const auto point = [&](double extent) {
    return glm::dvec3(uniform(random), uniform(random), uniform(random)) * extent;
  };
  std::vector<InputTriangle> triangles;
  for (int i = 0; i < count; ++i) {
    const double extent = largest * std::pow(10.0, -3 * uniform(random));
    const glm::dvec3 base = offset + point(size * (1 - extent));
    const std::array<glm::dvec3, 4> p = {base + point(size * extent), base + point(size * extent),
                                         base + point(size * extent), base + point(size * extent)};
    for (const auto& [a, b, c] : {std::array{0, 1, 2}, std::array{0, 3, 1}, std::array{1, 3, 2}, std::array{2, 3, 0}})
      triangles.push_back(inputTriangle(p[a], p[b], p[c]));
  }
  return triangles;
}

double inputArea(const std::vector<InputTriangle>& triangles) {
  double sum = 0;
  for (const InputTriangle& t : triangles)
    sum += 0.5 * glm::length(glm::cross(t.positions[1] - t.positions[0], t.positions[2] - t.positions[0]));
  return sum;
}

constexpr uint64_t kMemoryBytes = uint64_t{1} << 30;

Result<Partition> partitioned(const std::vector<InputTriangle>& triangles, const BuildSettings& settings,
                              int threads = 2) {
  MemoryMesh mesh(triangles);
  Progress silent(false);
  const TemporaryDirectory directory;
  return partitionMesh(mesh, settings, {directory.path(), threads, kMemoryBytes}, silent);
}

double leafArea(const Partition& partition) {
  double sum = 0;
  for (const Leaf& leaf : partition.leaves) {
    const GridTriangles list = partition.triangles.read(leaf.list).value();
    for (const GridTriangle& t : list.triangles)
      sum += 0.5 *
             glm::length(glm::cross(glm::dvec3(t.corners[1] - t.corners[0]), glm::dvec3(t.corners[2] - t.corners[0])));
  }
  return sum * partition.grid.step() * partition.grid.step();
}

bool isAncestor(CellKey above, CellKey below) {
  while (below.level > above.level) below = below.parent();
  return above == below;
}

TEST(PartitionMesh, LeavesTileTheModelAtAnyScaleAndOffset) {
  const uint32_t seed = std::random_device{}();
  SCOPED_TRACE(seed);
  for (const auto& [size, offset] :
       {std::pair{1.0, 0.0}, std::pair{1e-20, 0.0}, std::pair{1e20, 0.0}, std::pair{1e4, 5e6}}) {
    std::mt19937 random(seed);
    const auto triangles = tetrahedra(random, 2000, size, glm::dvec3(offset));
    BuildSettings settings;
    settings.leafTriangles = 500;
    const Result<Partition> partition = partitioned(triangles, settings);
    ASSERT_TRUE(partition) << partition.error().message;
    EXPECT_GT(partition->leaves.size(), 20u);
    EXPECT_NEAR(leafArea(*partition) / inputArea(triangles), 1.0, 1e-4);
    for (size_t i = 0; i < partition->leaves.size(); ++i) {
      const Leaf& leaf = partition->leaves[i];
      const GridBox box = cellBox(partition->grid, leaf.key);
      EXPECT_TRUE(glm::all(glm::greaterThanEqual(leaf.content.min, box.min)));
      EXPECT_TRUE(glm::all(glm::lessThanEqual(leaf.content.max, box.max)));
      if (i > 0) {
        EXPECT_FALSE(isAncestor(partition->leaves[i - 1].key, leaf.key));
      }
    }
  }
}

TEST(PartitionMesh, NoLeafHoldsMoreThanItMayUnlessTheDepthLimitSaysSo) {
  std::mt19937 random(7);
  BuildSettings settings;
  settings.leafTriangles = 300;
  settings.maxLevel = 4;
  const auto partition = partitioned(tetrahedra(random, 3000, 1, glm::dvec3(0), 0.01), settings);
  ASSERT_TRUE(partition);
  for (const Leaf& leaf : partition->leaves) {
    EXPECT_LE(leaf.key.level, 4u);
    if (leaf.key.level < 4) {
      EXPECT_LE(partition->triangles.size(leaf.list), 300u);
    }
  }
}

TEST(PartitionMesh, AFixedLevelPutsEveryLeafThere) {
  std::mt19937 random(8);
  BuildSettings settings;
  settings.fixedLevel = 3;
  const auto partition = partitioned(tetrahedra(random, 500, 1, glm::dvec3(0)), settings);
  ASSERT_TRUE(partition);
  for (const Leaf& leaf : partition->leaves) EXPECT_EQ(leaf.key.level, 3u);
}

// Every third triangle is textured; coordinates are positions, so that each piece can be checked by itself.
TEST(PartitionMesh, TexturesGoWithTheirTriangles) {
  const uint32_t seed = std::random_device{}();
  SCOPED_TRACE(seed);
  std::mt19937 random(seed);
  auto triangles = tetrahedra(random, 3000, 1, glm::dvec3(0));
  for (size_t i = 0; i < triangles.size(); ++i) {
    triangles[i].texture = i % 3 == 0 ? kNoTexture : static_cast<uint32_t>(i % 3);
    for (size_t k = 0; k < 3; ++k)
      triangles[i].textureCoordinates[k] = glm::vec2(triangles[i].positions[k].x, triangles[i].positions[k].y);
  }
  triangles[1].textureCoordinates[2].y = std::numeric_limits<float>::quiet_NaN();
  BuildSettings settings;
  settings.leafTriangles = 300;
  const auto partition = partitioned(triangles, settings);
  ASSERT_TRUE(partition);
  size_t textured = 0, plain = 0;
  for (const Leaf& leaf : partition->leaves) {
    const auto check = [&](const GridTriangleSpan& portion) -> Result<> {
      for (size_t i = 0; i < portion.size(); ++i) {
        const TriangleTexture texture = portion.texture(i);
        (texture.texture == kNoTexture ? plain : textured) += 1;
        for (size_t k = 0; texture.texture != kNoTexture && k < 3; ++k) {
          const glm::dvec3 at = partition->grid.worldFromGrid(portion.triangles[i].corners[k]);
          EXPECT_NEAR(texture.coordinates[k].x, at.x, 1e-5);
          EXPECT_NEAR(texture.coordinates[k].y, at.y, 1e-5);
        }
      }
      return {};
    };
    ASSERT_TRUE(partition->triangles.forEachPortion(leaf.list, 100, check));
  }
  EXPECT_GT(textured, 1.5 * static_cast<double>(plain));
  EXPECT_GE(plain, triangles.size() / 3);
}

TEST(PartitionMesh, PointsThatNoSplitCanSeparateEndAtTheDepthLimit) {
  std::vector<InputTriangle> triangles(2000, inputTriangle({0, 0, 0}, {1, 0, 0}, {0, 1, 0}));
  triangles.push_back(inputTriangle({0, 0, 0}, {1e6, 0, 0}, {0, 1e6, 0}));
  BuildSettings settings;
  settings.leafTriangles = 100;
  settings.maxLevel = 6;
  const auto partition = partitioned(triangles, settings);
  ASSERT_TRUE(partition) << partition.error().message;
  EXPECT_NEAR(leafArea(*partition) / inputArea(triangles), 1.0, 1e-3);
}

TEST(PartitionMesh, LargeTrianglesThatAllCoverTheModelAreNotMultiplied) {
  const std::vector<InputTriangle> triangles(3000, inputTriangle({0, 0, 0}, {1, 0, 0.3}, {0, 1, 0.7}));
  BuildSettings settings;
  settings.leafTriangles = 100;
  const auto partition = partitioned(triangles, settings);
  ASSERT_TRUE(partition) << partition.error().message;
  uint64_t pieces = 0;
  for (const Leaf& leaf : partition->leaves) pieces += partition->triangles.size(leaf.list);
  EXPECT_LT(pieces, 3u * triangles.size());
}

TEST(PartitionMesh, AModelWithoutTrianglesIsAnError) {
  const auto partition = partitioned({}, BuildSettings{});
  ASSERT_FALSE(partition);
  EXPECT_EQ(partition.error().kind, ErrorKind::corrupt);
}

}  // namespace
}  // namespace farcell
