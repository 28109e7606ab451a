#include <gtest/gtest.h>

#include <clocale>
#include <random>

#include "cache/schema/model.h"
#include "tests/preprocess/read/read_support.h"

namespace farcell::test {
namespace {

constexpr const char* kSquare = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";

uint32_t albedo() { return kDefaultAlbedo[0] | uint32_t{kDefaultAlbedo[1]} << 8 | uint32_t{kDefaultAlbedo[2]} << 16; }

ReadMesh readText(const TempDirectory& directory, const std::string& text) {
  return readGood(directory.write("mesh.obj", text));
}

TEST(ObjReader, FansPolygonsAndPassesOverTheRest) {
  const TempDirectory directory;
  const ReadMesh mesh = readText(
      directory, std::string("# a comment\nmtllib missing.mtl\no one\ng a b\ns 1\n") + kSquare +
                     "vt 0 0\nvp 1 2\nl 1 2\np 1\nf 1 2 3 4 # square\nf 1/1 2/1 3/1\nf 1 2\nf\n\n   \nunknown 1 2 3\n");
  EXPECT_EQ(mesh.info.vertices, 4u);
  EXPECT_EQ(mesh.info.declaredTriangles, 3u);
  ASSERT_EQ(mesh.triangles.size(), 3u);
  EXPECT_EQ(mesh.triangles[1].positions,
            (std::array<glm::dvec3, 3>{glm::dvec3(0), glm::dvec3(1, 1, 0), glm::dvec3(0, 1, 0)}));
  EXPECT_FALSE(mesh.info.hasColours);
  EXPECT_FALSE(mesh.info.hasNormals);
}

TEST(ObjReader, KeepsDoublesToTheLastBit) {
  const TempDirectory directory;
  const ReadMesh mesh = readText(directory, "v 500000.001 +5e6 -0.1\nv 1 0 0 1.0\nv 0 1 0\nf 1 2 3\n");
  ASSERT_EQ(mesh.triangles.size(), 1u);
  EXPECT_EQ(mesh.triangles[0].positions[0], glm::dvec3(500000.001, 5e6, -0.1));
}

TEST(ObjReader, CountsNegativeIndicesBackFromTheFace) {
  const TempDirectory directory;
  const ReadMesh mesh =
      readText(directory, "v 9 9 9\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf -3 -2 -1\nv 0 0 1\nf -1 -3 -2\nf -6 2 3\n");
  ASSERT_EQ(mesh.triangles.size(), 2u);
  EXPECT_EQ(mesh.triangles[0].positions[0], glm::dvec3(0, 0, 0));
  EXPECT_EQ(mesh.triangles[1].positions,
            (std::array<glm::dvec3, 3>{glm::dvec3(0, 0, 1), glm::dvec3(1, 0, 0), glm::dvec3(0, 1, 0)}));
  EXPECT_EQ(mesh.counts.skipped.at(kSkippedBadIndex), 1u);
}

TEST(ObjReader, SkipsOnlyTheTrianglesThatUseABadIndex) {
  const TempDirectory directory;
  const ReadMesh mesh =
      readText(directory, std::string(kSquare) + "f 1 2 3 0 4\nf 5 1 2\nf 9223372036854775807 1 2\nf 1 2 2\nf 1 2 3\n");
  EXPECT_EQ(mesh.counts.accepted, 2u);
  EXPECT_EQ(mesh.counts.skipped.at(kSkippedBadIndex), 4u);
  EXPECT_EQ(mesh.counts.skipped.at(kSkippedZeroArea), 1u);
}

TEST(ObjReader, MayUseVerticesThatComeLater) {
  const TempDirectory directory;
  EXPECT_EQ(readText(directory, std::string("f 1 2 3\n") + kSquare).counts.accepted, 1u);
}

TEST(ObjReader, HasNormalsOnlyWhereEveryCornerHasOne) {
  const TempDirectory directory;
  const std::string start = std::string(kSquare) + "vn 0 0 1\nvn 0 1 0\n";
  const ReadMesh all = readText(directory, start + "f 1//1 2//2 3//-1\nf 1/7/1 2/8/1 3/9/1\n");
  EXPECT_TRUE(all.info.hasNormals);
  EXPECT_EQ(all.triangles[0].normals[0], glm::vec3(0, 0, 1));
  EXPECT_EQ(all.triangles[0].normals[2], glm::vec3(0, 1, 0));
  EXPECT_FALSE(readText(directory, start + "f 1//1 2//2 3//1\nf 1 2 3\n").info.hasNormals);
  const ReadMesh bad = readText(directory, start + "f 1//1 2//2 3//3\n");
  EXPECT_FALSE(bad.info.hasNormals);
  EXPECT_EQ(bad.counts.accepted, 1u);
}

TEST(ObjReader, JoinsContinuedLines) {
  const TempDirectory directory;
  EXPECT_EQ(readText(directory, "v 0 0 \\\n0\nv 1 \\\r\n 0 0\nv 0 1 0\nf 1 \\\n2 \\\n3\n").counts.accepted, 1u);
  EXPECT_EQ(readText(directory, std::string(kSquare) + "f 1 2 3 \\").counts.accepted, 1u);
}

TEST(ObjReader, PrefersVertexColoursToMaterialsAndThoseToTheDefault) {
  const TempDirectory directory;
  directory.write("my colours.mtl",
                  "# x\nnewmtl red\nKa 1 1 1\nKd 1 0 0\nnewmtl deep blue\nKd 0 0 0.5\nnewmtl none\nNs 3\n");
  const ReadMesh mesh = readText(
      directory,
      "mtllib my colours.mtl\nv 0 0 0 0 1 0\nv 1 0 0\nv 1 1 0\nf 1 2 3\nusemtl red\nf 1 2 3\nusemtl deep blue\n"
      "f 2 3 1\nusemtl none\nf 1 2 3\nusemtl unknown\nf 3 1 2\n");
  EXPECT_TRUE(mesh.info.hasColours);
  ASSERT_EQ(mesh.triangles.size(), 5u);
  constexpr uint32_t kGreen = 0x00ff00;
  EXPECT_EQ(mesh.triangles[0].colours, (std::array<uint32_t, 3>{kGreen, albedo(), albedo()}));
  EXPECT_EQ(mesh.triangles[1].colours, (std::array<uint32_t, 3>{kGreen, 0x0000ff, 0x0000ff}));
  EXPECT_EQ(mesh.triangles[2].colours, (std::array<uint32_t, 3>{0x800000, 0x800000, kGreen}));
  EXPECT_EQ(mesh.triangles[3].colours, mesh.triangles[0].colours);
  EXPECT_EQ(mesh.triangles[4].colours, (std::array<uint32_t, 3>{albedo(), kGreen, albedo()}));
}

TEST(ObjReader, HasColoursByMaterialAloneWhenAFaceUsesOne) {
  const TempDirectory directory;
  directory.write("a.mtl", "newmtl a\nKd 0 1 1\n");
  EXPECT_TRUE(
      readText(directory, std::string("mtllib b.mtl a.mtl\nusemtl a\n") + kSquare + "f 1 2 3\n").info.hasColours);
  EXPECT_FALSE(readText(directory, std::string("mtllib a.mtl\nusemtl b\n") + kSquare + "f 1 2 3\n").info.hasColours);
  EXPECT_TRUE(readText(directory, std::string("v 5 5 5\nv 4 4 4 1 1 1\n") + kSquare + "f 3 4 5\n").info.hasColours);
}

TEST(ObjReader, NamesItsMaterialLibrariesEachOnce) {
  const TempDirectory directory;
  directory.write("a.mtl", "newmtl a\nKd 0 1 1\n");
  directory.write("b c.mtl", "newmtl b\n");
  const auto path =
      directory.write("mesh.obj", std::string("mtllib b c.mtl\nmtllib missing.mtl a.mtl ./a.mtl\nmtllib a.mtl\n") +
                                      kSquare + "f 1 2 3\n");
  const auto reader = openMesh(path);
  ASSERT_TRUE(reader);
  EXPECT_EQ((*reader)->files(),
            (std::vector<std::filesystem::path>{path, directory.path() / "b c.mtl", directory.path() / "a.mtl"}));
}

TEST(ObjReader, ReadsNoMaterialsOutsideItsDirectory) {
  const TempDirectory outer;
  const std::filesystem::path outside = outer.write("out.mtl", "newmtl a\nKd 0 1 1\n");
  const auto inner = outer.path() / "inner";
  std::filesystem::create_directories(inner / "sub");
  std::filesystem::copy_file(outside, inner / "sub" / "in.mtl");
  const auto hasColours = [&](const std::string& library) {
    return readGood(outer.write("inner/mesh.obj", "mtllib " + library + "\nusemtl a\n" + kSquare + "f 1 2 3\n"))
        .info.hasColours;
  };
  EXPECT_TRUE(hasColours("sub/in.mtl"));
  EXPECT_FALSE(hasColours("../out.mtl"));
  EXPECT_FALSE(hasColours("sub/../../out.mtl"));
  EXPECT_FALSE(hasColours(outside.string()));
  EXPECT_FALSE(hasColours("sub"));
}

TEST(ObjReader, SurvivesEveryTruncationAndChangedBytes) {
  const TempDirectory directory;
  directory.write("a.mtl", "newmtl a\nKd 0 1 1\n");
  const std::string whole =
      std::string("mtllib a.mtl\nusemtl a\n") + kSquare +
      "v 2 2 2 0.5 0.5 0.5\nvn 0 0 1\nvt 0 0\nf 1/1/1 2/1/1 3/1/1 4/1/1\nf -1//-1 -2//-1 \\\n -3//-1\ng x\nf 1 3 5\n";
  EXPECT_EQ(readText(directory, whole).triangles.size(), 4u);
  for (size_t length = 0; length < whole.size(); ++length)
    (void)readMesh(directory.write("cut.obj", whole.substr(0, length)));
  constexpr uint32_t kSeed = 77;
  SCOPED_TRACE(fmt::format("seed {}", kSeed));
  std::mt19937 random(kSeed);
  int readable = 0;
  for (int round = 0; round < 2000; ++round) {
    std::string bytes = whole;
    for (uint32_t i = 0; i <= random() % 4; ++i) bytes[random() % bytes.size()] = static_cast<char>(random());
    readable += readMesh(directory.write("changed.obj", bytes)).has_value();
  }
  EXPECT_GT(readable, 100);
}

TEST(ObjReader, ReadsLinesLongerThanItsBuffer) {
  const TempDirectory directory;
  std::string text = "v 0 0 0\n";
  constexpr int kCorners = 100000;
  for (int i = 0; i < kCorners; ++i) text += fmt::format("v {} 1 {}\n", i, i % 7);
  text += "f 1";
  for (int i = 0; i < kCorners; ++i) text += fmt::format(" {}", i + 2);
  EXPECT_EQ(readText(directory, text).counts.accepted, uint64_t{kCorners - 1});
}

}  // namespace
}  // namespace farcell::test
