#include "preprocess/read/stl/stl_reader.h"

#include "cache/base/process.h"
#include "cache/schema/model.h"
#include "tests/preprocess/read/stl/stl_samples.h"

namespace farcell::test {
namespace {

constexpr uint32_t kAlbedo = kDefaultAlbedo[0] | kDefaultAlbedo[1] << 8 | kDefaultAlbedo[2] << 16;

TEST(StlReader, ReadsTheSameTrianglesFromTextAndBinary) {
  const TempDirectory directory;
  const std::vector<Facet> facets = {facetAt(0), facetAt(1.5f), facetAt(-0.375f)};
  const ReadMesh text = readGood(directory.write("text.stl", textStl(facets)));
  const ReadMesh binary = readGood(directory.write("binary.stl", binaryStl(facets)));
  EXPECT_EQ(text.info.format, "STL, ASCII");
  EXPECT_EQ(binary.info.format, "STL, binary");
  for (const ReadMesh& mesh : {text, binary}) {
    ASSERT_EQ(mesh.triangles.size(), facets.size());
    EXPECT_EQ(mesh.info.vertices, 9u);
    EXPECT_FALSE(mesh.info.hasColours);
    EXPECT_FALSE(mesh.info.hasNormals);
    for (size_t i = 0; i < facets.size(); ++i)
      for (size_t k = 0; k < 3; ++k) EXPECT_EQ(mesh.triangles[i].positions[k], glm::dvec3(facets[i].corners[k]));
    EXPECT_EQ(mesh.triangles[0].colours, (std::array<uint32_t, 3>{kAlbedo, kAlbedo, kAlbedo}));
    EXPECT_EQ(mesh.triangles[0].texture, kNoTexture);
  }
}

TEST(StlReader, TakesABinaryFileForOneThoughItsHeaderBeginsLikeText) {
  const TempDirectory directory;
  const std::string header = "solid made by a program that did not know better, facet normal 0 0 0";
  const ReadMesh mesh = readGood(directory.write("solid.stl", binaryStl({facetAt(0), facetAt(1)}, header)));
  EXPECT_EQ(mesh.info.format, "STL, binary");
  EXPECT_EQ(mesh.triangles.size(), 2u);
}

TEST(StlReader, ReadsTextHoweverItIsLaidOut) {
  const TempDirectory directory;
  const auto count = [&](const std::string& text) {
    return readGood(directory.write("layout.stl", text)).triangles.size();
  };
  EXPECT_EQ(count("\n \t\r\nSOLID a NAME with facet in it\r\nFacet Normal 0 0 1 Outer LOOP Vertex 0 0 0\r\n"
                  "VERTEX +1 0 0 vertex 0 1e0 0 EndLoop EndFacet\r\nEndSolid a NAME"),
            1u);
  // A name that ends with a backslash does not swallow the next line; neither does one that is missing.
  const std::string facet = textFacet(facetAt(0));
  EXPECT_EQ(count("solid c:\\models\\\n" + facet + "endsolid\n"), 1u);
  EXPECT_EQ(count("solid\n" + facet + facet + "endsolid\n"), 2u);
  EXPECT_EQ(count("solid one\n" + facet + "endsolid one\n\nsolid two\n" + facet + "endsolid two\n\n"), 2u);
  EXPECT_EQ(count("solid nothing\nendsolid nothing\n"), 0u);
}

TEST(StlReader, KeepsTheDoublesOfText) {
  const TempDirectory directory;
  std::string text = textStl({facetAt(0)});
  text.replace(text.find("vertex 0 0 0"), 12, "vertex 500000.001 0.1 -5e6");
  const ReadMesh mesh = readGood(directory.write("doubles.stl", text));
  ASSERT_EQ(mesh.triangles.size(), 1u);
  EXPECT_EQ(mesh.triangles[0].positions[0], glm::dvec3(500000.001, 0.1, -5e6));
}

TEST(StlReader, TakesAnyNormalAndUsesNone) {
  const TempDirectory directory;
  for (const char* normal : {"0 0 0", "nan nan nan", "-1.#IND 0 0", "-nan(ind) 1e99 0", "5 6 7"}) {
    std::string text = textStl({facetAt(0)});
    text.replace(text.find("0 0 1\n"), 5, normal);
    const ReadMesh mesh = readGood(directory.write("normal.stl", text));
    EXPECT_EQ(mesh.triangles.size(), 1u) << normal;
    EXPECT_FALSE(mesh.info.hasNormals);
  }
}

TEST(StlReader, CountsWhatCannotBeDrawn) {
  const TempDirectory directory;
  Facet flat = facetAt(0), nan = facetAt(1), infinite = facetAt(2);
  flat.corners[2] = flat.corners[1];
  nan.corners[1].y = std::numeric_limits<float>::quiet_NaN();
  infinite.corners[0].z = -std::numeric_limits<float>::infinity();
  const std::vector<Facet> facets = {flat, nan, facetAt(3), infinite};
  for (const std::string& bytes : {textStl(facets), binaryStl(facets)}) {
    const ReadMesh mesh = readGood(directory.write("bad.stl", bytes));
    EXPECT_EQ(mesh.info.declaredTriangles, 4u);
    EXPECT_EQ(mesh.counts.accepted, 1u);
    EXPECT_EQ(mesh.counts.skipped, (std::map<std::string, uint64_t>{{kSkippedNonFinite, 2}, {kSkippedZeroArea, 1}}));
  }
}

std::vector<uint32_t> coloursOf(const TempDirectory& directory, const std::string& header,
                                const std::vector<uint16_t>& attributes) {
  std::vector<Facet> facets;
  for (const uint16_t attribute : attributes) {
    facets.push_back(facetAt(static_cast<float>(facets.size())));
    facets.back().attribute = attribute;
  }
  const ReadMesh mesh = readGood(directory.write("colour.stl", binaryStl(facets, header)));
  std::vector<uint32_t> colours;
  for (const InputTriangle& triangle : mesh.triangles)
    if (mesh.info.hasColours) colours.push_back(triangle.colours[0]);
  return colours;
}

TEST(StlReader, ReadsTheColoursOfVisCam) {
  const TempDirectory directory;
  // Bit 15: has a colour; then five bits each of red, green, blue.
  EXPECT_EQ(coloursOf(directory, "", {0x8000 | 31 << 10, 0x8000 | 31 << 5, 0x8000 | 31, 0x7fff, 0x8000 | 16 << 10}),
            (std::vector<uint32_t>{0x0000ff, 0x00ff00, 0xff0000, kAlbedo, 0x000084}));
  EXPECT_EQ(coloursOf(directory, "", {0, 0x7fff, 12}), std::vector<uint32_t>{}) << "no facet says it has one";
}

TEST(StlReader, ReadsTheColoursOfMagics) {
  const TempDirectory directory;
  // Bit 15: has the object's colour; then five bits each of blue, green, red.
  const std::string header = std::string("x COLOR=") + "\x10\x20\x30\xff" + ",MATERIAL=abcd";
  EXPECT_EQ(coloursOf(directory, header, {31 << 10, 31 << 5, 31, 0x8000, 0xffff, 0}),
            (std::vector<uint32_t>{0xff0000, 0x00ff00, 0x0000ff, 0x302010, 0x302010, 0x000000}));
  // A mark that the header has no room for the colour of is none.
  EXPECT_EQ(coloursOf(directory, std::string(71, ' ') + "COLOR=RGB", {0, 0}), std::vector<uint32_t>{});
}

TEST(StlReader, GivesTheSameTrianglesOnEveryPassAndHandsTheErrorOfTheSinkOn) {
  const TempDirectory directory;
  std::vector<Facet> facets;
  for (int i = 0; i < 5000; ++i) facets.push_back(facetAt(static_cast<float>(i)));  // more than a batch
  for (const std::string& bytes : {textStl(facets), binaryStl(facets)}) {
    auto reader = openMesh(directory.write("passes.stl", bytes));
    ASSERT_TRUE(reader);
    MeshCounts counts;
    const auto first = collect(**reader, counts), second = collect(**reader, counts);
    ASSERT_TRUE(first && second);
    EXPECT_EQ(first->size(), 5000u);
    EXPECT_TRUE(std::equal(first->begin(), first->end(), second->begin(), second->end(), samePositions));
    int calls = 0;
    const auto result = (*reader)->forEachTriangle([&](std::span<const InputTriangle>) -> Result<> {
      ++calls;
      return fail(ErrorKind::exhausted, "enough");
    });
    ASSERT_FALSE(result);
    EXPECT_EQ(result.error().message, "enough");
    EXPECT_EQ(calls, 1);
  }
}

TEST(StlReader, KeepsNothingOfALargeFileInMemory) {
  const TempDirectory directory;
  const std::string facets(50 * size_t{1'000'000}, '\0');
  const auto path = directory.write("large.stl", std::string(80, ' ') + std::string("\x40\x42\x0f\0", 4) + facets);
  const uint64_t before = peakRssBytes();
  const auto reader = openMesh(path);
  ASSERT_TRUE(reader);
  const auto counts = (*reader)->forEachTriangle([](std::span<const InputTriangle>) -> Result<> { return {}; });
  ASSERT_TRUE(counts);
  EXPECT_EQ(counts->skipped.at(kSkippedZeroArea), 1'000'000u);
  EXPECT_LT(peakRssBytes() - before, uint64_t{8} << 20);
}

}  // namespace
}  // namespace farcell::test
