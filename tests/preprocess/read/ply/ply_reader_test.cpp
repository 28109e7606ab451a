#include <gtest/gtest.h>

#include "tests/preprocess/read/read_support.h"

namespace farcell::test {
namespace {

constexpr std::array<Encoding, 3> kEncodings = {Encoding::ascii, Encoding::little, Encoding::big};
constexpr const char* kFloatVertex = "property float x\nproperty float y\nproperty float z\n";

void putSquare(PlyBody& body) {
  for (const auto& [x, y] : {std::pair{0.f, 0.f}, {1.f, 0.f}, {1.f, 1.f}, {0.f, 1.f}}) body.put(x, y, 0.5f).endRow();
}

std::string square(Encoding encoding, const std::string& faceElement, const PlyBody& faces) {
  PlyBody body(encoding);
  putSquare(body);
  return plyHeader(encoding, fmt::format("element vertex 4\n{}{}", kFloatVertex, faceElement)) + body.bytes() +
         faces.bytes();
}

// Every feature at once: elements and properties that are not used, before, between and after those that are; lists
// in all of them; polygons of 0 to 5 corners; strips.
std::string everything(Encoding encoding) {
  PlyBody body(encoding);
  body.put(uint8_t{2}, 1.5, 2.5, int16_t{-7}).endRow();
  for (int i = 0; i < 6; ++i) {
    const auto f = static_cast<float>(i);
    body.put(uint8_t{1}, int32_t{9}, 0.1f * f, uint8_t(40 * i), uint8_t(255 - i), uint8_t(3), f * f, 0.25f, 0.f, f, 1.f,
             int8_t{-1});
    body.endRow();
  }
  body.put(int32_t{0}, int32_t{1}).endRow();
  body.put(uint8_t{4}, int32_t{5}, uint16_t{4}, int16_t{0}, int16_t{1}, int16_t{2}, int16_t{3}).endRow();
  body.put(uint8_t{4}, int32_t{5}, uint16_t{2}, int16_t{0}, int16_t{1}).endRow();
  body.put(uint8_t{4}, int32_t{5}, uint16_t{0}).endRow();
  body.put(uint8_t{4}, int32_t{5}, uint16_t{5}, int16_t{1}, int16_t{2}, int16_t{3}, int16_t{4}, int16_t{5}).endRow();
  body.put(int32_t{9}, int32_t{0}, int32_t{1}, int32_t{2}, int32_t{3}, int32_t{-1}, int32_t{3}, int32_t{4}, int32_t{5},
           int32_t{0})
      .endRow();
  return plyHeader(encoding,
                   "comment all of it\nobj_info made by a test\n"
                   "element camera 1\nproperty list uchar double k\nproperty short tag\n"
                   "element vertex 6\nproperty list uchar int more\nproperty float x\n"
                   "property uchar red\nproperty uchar green\nproperty uchar blue\n"
                   "property float y\nproperty float z\nproperty float nx\nproperty float ny\nproperty float "
                   "nz\nproperty char last\n"
                   "element edge 1\nproperty int vertex1\nproperty int vertex2\n"
                   "element face 4\nproperty uchar flags\nproperty int group\nproperty list ushort short vertex_index\n"
                   "element tristrips 1\nproperty list int int vertex_indices\n") +
         body.bytes();
}

glm::dvec3 pointOfEverything(int i) {
  const auto f = static_cast<float>(i);
  return glm::dvec3(0.1f * f, f * f, 0.25f);
}

TEST(PlyReader, ReadsEveryFeatureInEveryEncoding) {
  const TempDirectory directory;
  // Fan of a quad, fan of a pentagon, strip 0 1 2 3 (second triangle turned), strip 3 4 5 0.
  const std::vector<std::array<int, 3>> expected = {{0, 1, 2}, {0, 2, 3}, {1, 2, 3}, {1, 3, 4}, {1, 4, 5},
                                                    {0, 1, 2}, {2, 1, 3}, {3, 4, 5}, {5, 4, 0}};
  for (const Encoding encoding : kEncodings) {
    SCOPED_TRACE(formatName(encoding));
    const ReadMesh mesh = readGood(directory.write("all.ply", everything(encoding)));
    EXPECT_TRUE(mesh.info.hasColours);
    EXPECT_TRUE(mesh.info.hasNormals);
    EXPECT_EQ(mesh.info.vertices, 6u);
    ASSERT_EQ(mesh.triangles.size(), expected.size());
    for (size_t i = 0; i < expected.size(); ++i)
      for (size_t corner = 0; corner < 3; ++corner) {
        const int vertex = expected[i][corner];
        EXPECT_EQ(mesh.triangles[i].positions[corner], pointOfEverything(vertex));
        EXPECT_EQ(mesh.triangles[i].normals[corner], glm::vec3(0, float(vertex), 1));
        EXPECT_EQ(mesh.triangles[i].colours[corner], uint32_t(40 * vertex) | uint32_t(255 - vertex) << 8 | 3u << 16);
      }
  }
}

TEST(PlyReader, GivesTheSameTrianglesOnEveryPass) {
  const TempDirectory directory;
  auto reader = openMesh(directory.write("all.ply", everything(Encoding::big)));
  ASSERT_TRUE(reader);
  MeshCounts counts;
  const auto first = collect(**reader, counts);
  const auto second = collect(**reader, counts);
  ASSERT_TRUE(first && second);
  EXPECT_TRUE(std::equal(first->begin(), first->end(), second->begin(), second->end(), samePositions));
}

TEST(PlyReader, KeepsDoublesToTheLastBit) {
  const TempDirectory directory;
  for (const Encoding encoding : kEncodings) {
    PlyBody body(encoding);
    body.put(500000.001, 0.1, 1e-300)
        .endRow()
        .put(500000.002, 0.1, 0.0)
        .endRow()
        .put(500000.001, 5000000.123456789, 0.0)
        .endRow();
    body.put(uint8_t{3}, int32_t{0}, int32_t{1}, int32_t{2}).endRow();
    const auto path = directory.write(
        "double.ply", plyHeader(encoding,
                                "element vertex 3\nproperty double x\nproperty double y\nproperty double z\n"
                                "element face 1\nproperty list uchar int vertex_indices\n") +
                          body.bytes());
    const ReadMesh mesh = readGood(path);
    ASSERT_EQ(mesh.triangles.size(), 1u);
    EXPECT_EQ(mesh.triangles[0].positions[0], glm::dvec3(500000.001, 0.1, 1e-300));
    EXPECT_EQ(mesh.triangles[0].positions[2], glm::dvec3(500000.001, 5000000.123456789, 0));
  }
}

TEST(PlyReader, TakesCoordinatesAndIndicesOfAnyType) {
  const TempDirectory directory;
  for (const Encoding encoding : kEncodings) {
    PlyBody body(encoding);
    body.put(int8_t{-3}, uint16_t{60000}, int32_t{2000000001}).endRow();
    body.put(int8_t{3}, uint16_t{0}, int32_t{1}).endRow().put(int8_t{0}, uint16_t{1}, int32_t{-1}).endRow();
    body.put(int32_t{3}, uint8_t{2}, uint8_t{1}, uint8_t{0}).endRow();
    const auto path = directory.write(
        "types.ply", plyHeader(encoding,
                               "element vertex 3\nproperty int8 x\nproperty uint16 y\nproperty int32 z\n"
                               "element face 1\nproperty list int32 uint8 vertex_index\n") +
                         body.bytes());
    const ReadMesh mesh = readGood(path);
    ASSERT_EQ(mesh.triangles.size(), 1u);
    EXPECT_EQ(mesh.triangles[0].positions[2], glm::dvec3(-3, 60000, 2000000001));
    EXPECT_EQ(mesh.triangles[0].positions[0], glm::dvec3(0, 1, -1));
  }
}

template <class T>
uint32_t firstColour(const TempDirectory& directory, Encoding encoding, const char* type, T r, T g, T b) {
  PlyBody body(encoding);
  for (int i = 0; i < 3; ++i) body.put(float(i == 1), float(i == 2), 0.f, r, g, b).endRow();
  body.put(uint8_t{3}, uint32_t{0}, uint32_t{1}, uint32_t{2}).endRow();
  const std::string elements = fmt::format(
      "element vertex 3\n{0}property {1} red\nproperty {1} green\nproperty {1} blue\n"
      "element face 1\nproperty list uchar uint vertex_indices\n",
      kFloatVertex, type);
  const ReadMesh mesh = readGood(directory.write("colour.ply", plyHeader(encoding, elements) + body.bytes()));
  EXPECT_TRUE(mesh.info.hasColours);
  return mesh.triangles.empty() ? 0 : mesh.triangles[0].colours[1];
}

TEST(PlyReader, ScalesColoursByTheirType) {
  const TempDirectory directory;
  for (const Encoding encoding : kEncodings) {
    EXPECT_EQ(firstColour<uint8_t>(directory, encoding, "uchar", 1, 128, 255), 0xff8001u);
    EXPECT_EQ(firstColour<uint16_t>(directory, encoding, "ushort", 257, 128 * 257, 65535), 0xff8001u);
    EXPECT_EQ(firstColour<float>(directory, encoding, "float", 1 / 255.f, 128 / 255.f, 7.f), 0xff8001u);
    EXPECT_EQ(firstColour<double>(directory, encoding, "double", -1, 0.5, 1), 0xff8000u);
  }
}

TEST(PlyReader, HasNoColoursOrNormalsWhereOneComponentIsMissing) {
  const TempDirectory directory;
  const ReadMesh mesh = readGood(
      directory.write("part.ply",
                      "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
                      "property uchar red\nproperty uchar green\nproperty float nx\nproperty float nz\n"
                      "element face 1\nproperty list uchar int vertex_indices\nend_header\n"
                      "0 0 0 1 2 0 1\n1 0 0 1 2 0 1\n0 1 0 1 2 0 1\n3 0 1 2\n"));
  EXPECT_FALSE(mesh.info.hasColours);
  EXPECT_FALSE(mesh.info.hasNormals);
  EXPECT_EQ(mesh.triangles.size(), 1u);
}

std::string withWindowsEnds(const std::string& text) {
  std::string windows;
  for (const char c : text) {
    if (c == '\n') windows.push_back('\r');
    windows.push_back(c);
  }
  return windows;
}

TEST(PlyReader, AcceptsWindowsLineEndsInHeaderAndText) {
  const TempDirectory directory;
  const std::string text =
      "ply\nformat ascii 1.0\ncomment x\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
      "element face 1\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n+1 0 0\n0\t1e0 -0\n3 0 1 2\n";
  EXPECT_EQ(readGood(directory.write("windows.ply", withWindowsEnds(text))).triangles.size(), 1u);

  PlyBody body(Encoding::little);
  putSquare(body);
  body.put(uint8_t{4}, int32_t{0}, int32_t{1}, int32_t{2}, int32_t{3});
  const std::string header = plyHeader(
      Encoding::little,
      fmt::format("element vertex 4\n{}element face 1\nproperty list uchar int vertex_indices\n", kFloatVertex));
  EXPECT_EQ(readGood(directory.write("binary.ply", withWindowsEnds(header) + body.bytes())).triangles.size(), 2u);
}

TEST(PlyReader, IsChosenByContentWhateverTheName) {
  const TempDirectory directory;
  EXPECT_EQ(readGood(directory.write("mesh.obj", everything(Encoding::little))).triangles.size(), 9u);
  EXPECT_EQ(readGood(directory.write("mesh", everything(Encoding::ascii))).triangles.size(), 9u);
}

TEST(PlyReader, SkipsOnlyTheTrianglesOfAPolygonThatUseABadIndex) {
  const TempDirectory directory;
  for (const Encoding encoding : kEncodings) {
    PlyBody faces(encoding);
    faces.put(uint8_t{5}, int32_t{0}, int32_t{1}, int32_t{2}, int32_t{4}, int32_t{3}).endRow();  // 4: out of range
    faces.put(uint8_t{3}, int32_t{-2}, int32_t{1}, int32_t{2}).endRow();
    faces.put(uint8_t{3}, int32_t{0}, int32_t{0}, int32_t{2}).endRow();
    const ReadMesh mesh = readGood(directory.write(
        "bad.ply", square(encoding, "element face 3\nproperty list uchar int vertex_indices\n", faces)));
    EXPECT_EQ(mesh.counts.accepted, 1u);
    EXPECT_EQ(mesh.counts.skipped.at(kSkippedBadIndex), 3u);
    EXPECT_EQ(mesh.counts.skipped.at(kSkippedZeroArea), 1u);
    EXPECT_EQ(mesh.info.declaredTriangles, 5u);
  }
}

TEST(PlyReader, CountsEveryWindowOfAStrip) {
  const TempDirectory directory;
  for (const Encoding encoding : kEncodings) {
    // 0 1 2 | 2 1 3 | 2 3 3: a stitch | 3 3 9: bad | 3 9 0: bad | then two indices alone: nothing.
    PlyBody strip(encoding);
    strip
        .put(int32_t{10}, int32_t{0}, int32_t{1}, int32_t{2}, int32_t{3}, int32_t{3}, int32_t{9}, int32_t{0},
             int32_t{-1}, int32_t{1}, int32_t{2})
        .endRow();
    const ReadMesh mesh = readGood(directory.write(
        "strip.ply", square(encoding, "element tristrips 1\nproperty list int int vertex_indices\n", strip)));
    EXPECT_EQ(mesh.info.declaredTriangles, 5u);
    EXPECT_EQ(mesh.counts.accepted, 2u);
    EXPECT_EQ(mesh.counts.skipped.at(kSkippedZeroArea), 1u);
    EXPECT_EQ(mesh.counts.skipped.at(kSkippedBadIndex), 2u);
  }
}

TEST(PlyReader, LeavesOutTrianglesThatAreNotFinite) {
  const TempDirectory directory;
  const std::string text =
      "ply\nformat ascii 1.0\nelement vertex 6\nproperty float x\nproperty float y\nproperty float z\n"
      "element face 4\nproperty list uchar int vertex_indices\nend_header\n"
      "0 0 0\n1 0 0\n0 1 0\nnan 0 0\n-inf 0 0\n1e39 0 0\n3 0 1 2\n3 0 1 3\n3 0 4 2\n3 5 1 2\n";
  const ReadMesh mesh = readGood(directory.write("nan.ply", text));
  EXPECT_EQ(mesh.counts.accepted, 1u);
  EXPECT_EQ(mesh.counts.skipped.at(kSkippedNonFinite), 3u);
}

TEST(PlyReader, HandsTheErrorOfTheSinkOn) {
  const TempDirectory directory;
  auto reader = openMesh(directory.write("all.ply", everything(Encoding::little)));
  ASSERT_TRUE(reader);
  const auto result = (*reader)->forEachTriangle(
      [](std::span<const InputTriangle>) -> Result<> { return fail(ErrorKind::exhausted, "enough"); });
  ASSERT_FALSE(result);
  EXPECT_EQ(result.error().message, "enough");
}

}  // namespace
}  // namespace farcell::test
