// The models beside the repository, whose README gives their counts; skipped where they are not there.
#include <gtest/gtest.h>

#include <cstdlib>

#include "tests/preprocess/read/read_support.h"

namespace farcell::test {
namespace {

std::filesystem::path model(const char* name) {
  return std::filesystem::path(FARCELL_SOURCE_DIR) / ".." / "shared" / "datasets" / name;
}

using Point = std::array<double, 3>;
using Edge = std::pair<Point, Point>;

// Sorted.
std::vector<Edge> directedEdges(std::span<const InputTriangle> triangles) {
  const auto key = [](glm::dvec3 p) { return Point{p.x, p.y, p.z}; };
  std::vector<Edge> edges;
  for (const InputTriangle& triangle : triangles)
    for (size_t i = 0; i < 3; ++i) edges.emplace_back(key(triangle.positions[i]), key(triangle.positions[(i + 1) % 3]));
  std::sort(edges.begin(), edges.end());
  return edges;
}

#define SKIP_WITHOUT(path) \
  if (!std::filesystem::exists(path)) GTEST_SKIP() << (path) << " is not there"

TEST(Models, EveryStripOfIgeaIsAccountedFor) {
  SKIP_WITHOUT(model("igea.ply"));
  const ReadMesh mesh = readGood(model("igea.ply"));
  EXPECT_EQ(mesh.info.declaredTriangles, 268686u);
  EXPECT_EQ(mesh.info.vertices, 134345u);
  // A closed surface of genus 0 has 2 V - 4 triangles (Euler), and where all face the same way, each edge is there
  // exactly once in each direction: every second triangle of a strip must have been turned.
  EXPECT_EQ(mesh.counts.accepted, 2 * mesh.info.vertices - 4);
  const std::vector<Edge> edges = directedEdges(mesh.triangles);
  EXPECT_EQ(std::adjacent_find(edges.begin(), edges.end()), edges.end());
  const bool closed = std::all_of(edges.begin(), edges.end(), [&](const Edge& edge) {
    return std::binary_search(edges.begin(), edges.end(), Edge{edge.second, edge.first});
  });
  EXPECT_TRUE(closed);
}

TEST(Models, EveryFaceOfNefertitiIsAccountedFor) {
  SKIP_WITHOUT(model("nefertiti.obj"));
  const ReadMesh mesh = readGood(model("nefertiti.obj"));
  EXPECT_EQ(mesh.info.declaredTriangles, 99938u);
  EXPECT_EQ(mesh.info.vertices, 49971u);
}

TEST(Models, EveryFaceOfSpotIsAccountedFor) {
  SKIP_WITHOUT(model("spot.obj"));
  const ReadMesh mesh = readGood(model("spot.obj"));
  EXPECT_EQ(mesh.info.declaredTriangles, 5856u);
  EXPECT_EQ(mesh.counts.accepted, 5856u);
  EXPECT_FALSE(mesh.info.hasColours);
}

TEST(Models, EveryTriangleOfTheTreeIsAccountedFor) {
  SKIP_WITHOUT(model("tree.glb"));
  const ReadMesh mesh = readGood(model("tree.glb"));  // accepted + skipped == declared
  EXPECT_EQ(mesh.info.declaredTriangles, 5354u);
  EXPECT_TRUE(mesh.info.hasColours);
  const auto reader = openMesh(model("tree.glb"));
  ASSERT_TRUE(reader);
  EXPECT_FALSE((*reader)->textures().empty());
  for (const InputTriangle& triangle : mesh.triangles) ASSERT_LT(triangle.texture, (*reader)->textures().size());
}

TEST(Models, EveryFaceOfLinzIsAccountedFor) {
  SKIP_WITHOUT(model("linz-west.ply.xz"));
  const TempDirectory directory;
  const auto plain = directory.path() / "linz-west.ply";
  const std::string command =
      fmt::format("xz -dc '{}' > '{}' 2>/dev/null", model("linz-west.ply.xz").string(), plain.string());
  if (std::system(command.c_str()) != 0) GTEST_SKIP() << "xz is not there";
  const ReadMesh mesh = readGood(plain);
  EXPECT_EQ(mesh.info.declaredTriangles, 1271014u);
  EXPECT_EQ(mesh.info.vertices, 1376980u);
  EXPECT_TRUE(mesh.info.hasColours);
  EXPECT_FALSE(mesh.info.hasNormals);
  // Slivers stay: rational arithmetic on the file's floats finds 57 triangles of exactly no area.
  EXPECT_EQ(mesh.counts.skipped, (std::map<std::string, uint64_t>{{kSkippedZeroArea, 57}}));
}

}  // namespace
}  // namespace farcell::test
