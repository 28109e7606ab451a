#include "preprocess/read/off/off_reader.h"

#include "cache/schema/model.h"
#include "tests/preprocess/read/off/off_samples.h"

namespace farcell::test {
namespace {

constexpr uint32_t kAlbedo = kDefaultAlbedo[0] | kDefaultAlbedo[1] << 8 | kDefaultAlbedo[2] << 16;
constexpr const char* kCorners = "0 0 0\n1 0 0\n1 1 0\n0 1 0\n";

ReadMesh readText(const TempDirectory& directory, const std::string& text) {
  return readGood(directory.write("mesh.off", text));
}

TEST(OffReader, ReadsEveryFeature) {
  const TempDirectory directory;
  const ReadMesh mesh = readText(directory, kEveryOff);
  EXPECT_EQ(mesh.info.format, "OFF");
  EXPECT_EQ(mesh.info.vertices, 6u);
  EXPECT_TRUE(mesh.info.hasColours);
  EXPECT_TRUE(mesh.info.hasNormals);
  const std::array<glm::dvec3, 5> points = {glm::dvec3(0), {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 1}};
  const std::array<glm::vec3, 5> normals = {glm::vec3(0, 0, 1), {0, 0, 2}, {0, 1, 1}, {1, 0, 1}, {0, 0, 1}};
  const std::array<uint32_t, 5> colours = {0x0000ff, 0x00ff00, 0xff0000, 0x1e140a, 0x010101};
  const std::vector<std::array<size_t, 3>> expected = {{0, 1, 2}, {0, 1, 2}, {0, 2, 3}, {0, 1, 2},
                                                       {0, 2, 3}, {0, 3, 4}, {0, 1, 4}, {2, 3, 4}};
  ASSERT_EQ(mesh.triangles.size(), expected.size());
  for (size_t i = 0; i < expected.size(); ++i)
    for (size_t k = 0; k < 3; ++k) {
      EXPECT_EQ(mesh.triangles[i].positions[k], points[expected[i][k]]);
      EXPECT_EQ(mesh.triangles[i].normals[k], normals[expected[i][k]]);
      EXPECT_EQ(mesh.triangles[i].colours[k], colours[expected[i][k]]) << "a vertex's colour goes before its face's";
    }
}

TEST(OffReader, ReadsEveryCombinationOfPrefixes) {
  const TempDirectory directory;
  for (const bool st : {false, true})
    for (const bool c : {false, true})
      for (const bool n : {false, true}) {
        std::string text = fmt::format("{}{}{}OFF\n3 1 3\n", st ? "ST" : "", c ? "C" : "", n ? "N" : "");
        for (int i = 0; i < 3; ++i)
          text += fmt::format("{} {} 5{}{}{}\n", i % 2, i / 2, n ? " 0 3 4" : "", c ? " 0 128 255" : "",
                              st ? " 0.25 0.75" : "");
        const ReadMesh mesh = readText(directory, text + "3 0 1 2\n");
        ASSERT_EQ(mesh.triangles.size(), 1u) << text;
        EXPECT_EQ(mesh.info.hasColours, c);
        EXPECT_EQ(mesh.info.hasNormals, n);
        EXPECT_EQ(mesh.triangles[0].positions[2], glm::dvec3(0, 1, 5));
        EXPECT_EQ(mesh.triangles[0].colours[1], c ? 0xff8000u : kAlbedo);
        EXPECT_EQ(mesh.triangles[0].normals[0], n ? glm::vec3(0, 3, 4) : glm::vec3(0));
      }
}

// The first colour of each face of a square's files with these colour words after its faces.
std::vector<uint32_t> faceColours(const TempDirectory& directory, const std::vector<std::string>& words) {
  std::string text = fmt::format("OFF\n4 {} 0\n{}", words.size(), kCorners);
  for (const std::string& word : words) text += "3 0 1 2 " + word + "\n";
  const ReadMesh mesh = readText(directory, text);
  std::vector<uint32_t> colours;
  for (const InputTriangle& triangle : mesh.triangles)
    if (mesh.info.hasColours) colours.push_back(triangle.colours[0]);
  return colours;
}

TEST(OffReader, TellsBytesFromUnitsInFaceColours) {
  const TempDirectory directory;
  using Colours = std::vector<uint32_t>;
  EXPECT_EQ(faceColours(directory, {"255 128 0", "1 1 1"}), (Colours{0x0080ff, 0x010101}));
  EXPECT_EQ(faceColours(directory, {"0.5 0 1.0", "1 0 0 1", "0 1e0 0"}), (Colours{0xff0080, 0x0000ff, 0x00ff00}));
  EXPECT_EQ(faceColours(directory, {"1 0 1", "0 0 0"}), (Colours{0xff00ff, 0x000000})) << "as %g writes units";
  EXPECT_EQ(faceColours(directory, {"255 0 0", "0.5 0.5 1"}), (Colours{0x0000ff, 0xff8080})) << "each by its own kind";
  EXPECT_EQ(faceColours(directory, {"0 200 0", "", "7"}), (Colours{0x00c800, kAlbedo, kAlbedo}));
  EXPECT_EQ(faceColours(directory, {"", "7", "# 1 2 3"}), Colours{}) << "no colour but of Geomview's own map";
  EXPECT_EQ(faceColours(directory, {"300 -5 0", "2.5 nan -1.0"}), (Colours{0x0000ff, 0x0000ff})) << "clamped";
}

TEST(OffReader, TellsBytesFromUnitsInVertexColours) {
  const TempDirectory directory;
  const auto colours = [&](const char* a, const char* b, const char* c) {
    const ReadMesh mesh =
        readText(directory, fmt::format("COFF\n3 1 0\n0 0 0 {}\n1 0 0 {}\n0 1 0 {}\n3 0 1 2 9 9 9\n", a, b, c));
    return mesh.triangles.empty() ? std::array<uint32_t, 3>{} : mesh.triangles[0].colours;
  };
  using Colours = std::array<uint32_t, 3>;
  EXPECT_EQ(colours("255 0 0", "0 1 0 255", "128 128 128 0"), (Colours{0x0000ff, 0x000100, 0x808080}));
  EXPECT_EQ(colours("1 0 0 1", "0.5 0.5 0.5 1", "0 1 1"), (Colours{0x0000ff, 0x808080, 0xffff00}));
  EXPECT_EQ(colours("1 0 0", "0 1 0", "1 1 1"), (Colours{0x0000ff, 0x00ff00, 0xffffff}));
  EXPECT_EQ(colours("1 0 0", "0 2 0", "0.004 1.0 0.0"), (Colours{0x000001, 0x000200, 0x00ff01}));
}

TEST(OffReader, TakesCountsBesideTheKeywordAndWithoutEdges) {
  const TempDirectory directory;
  EXPECT_EQ(readText(directory, std::string("OFF 4 1 0\n") + kCorners + "4 0 1 2 3\n").triangles.size(), 2u);
  EXPECT_EQ(readText(directory, std::string("OFF\r\n4 1\r\n") + kCorners + "4 0 1 2 3").triangles.size(), 2u);
  EXPECT_EQ(readText(directory, std::string("OFF\n4 0 0\n") + kCorners).info.declaredTriangles, 0u);
  EXPECT_EQ(readText(directory, "OFF\n0 0 0").info.vertices, 0u);
}

TEST(OffReader, KeepsDoublesToTheLastBit) {
  const TempDirectory directory;
  const ReadMesh mesh = readText(directory, "OFF\n3 1 0\n500000.001 +5e6 -0.1\n1 0 0\n0 1 0\n3 0 1 2\n");
  ASSERT_EQ(mesh.triangles.size(), 1u);
  EXPECT_EQ(mesh.triangles[0].positions[0], glm::dvec3(500000.001, 5e6, -0.1));
}

TEST(OffReader, CountsWhatCannotBeDrawn) {
  const TempDirectory directory;
  const ReadMesh mesh = readText(directory,
                                 "OFF\n6 5 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\nnan 0 0\n0 1e999 0\n"
                                 "5 0 1 2 6 3\n3 -1 1 2\n3 0 0 2\n3 4 1 2\n4 0 5 1 2\n");
  EXPECT_EQ(mesh.info.declaredTriangles, 8u);
  EXPECT_EQ(mesh.counts.accepted, 2u);
  EXPECT_EQ(mesh.counts.skipped,
            (std::map<std::string, uint64_t>{{kSkippedBadIndex, 3}, {kSkippedNonFinite, 2}, {kSkippedZeroArea, 1}}));
}

TEST(OffReader, IsChosenByContentWhateverTheName) {
  const TempDirectory directory;
  EXPECT_EQ(readGood(directory.write("mesh.ply", std::string("OFF\n4 1 0\n") + kCorners + "3 0 1 2\n")).info.format,
            "OFF");
  EXPECT_EQ(readGood(directory.write("mesh", std::string("COFF 0 0 0"))).info.format, "OFF");
}

TEST(OffReader, GivesTheSameTrianglesOnEveryPassAndHandsTheErrorOfTheSinkOn) {
  const TempDirectory directory;
  auto reader = openMesh(directory.write("mesh.off", kEveryOff));
  ASSERT_TRUE(reader);
  MeshCounts counts;
  const auto first = collect(**reader, counts), second = collect(**reader, counts);
  ASSERT_TRUE(first && second);
  EXPECT_TRUE(std::equal(first->begin(), first->end(), second->begin(), second->end(), samePositions));
  const auto result = (*reader)->forEachTriangle(
      [](std::span<const InputTriangle>) -> Result<> { return fail(ErrorKind::exhausted, "enough"); });
  ASSERT_FALSE(result);
  EXPECT_EQ(result.error().message, "enough");
}

}  // namespace
}  // namespace farcell::test
