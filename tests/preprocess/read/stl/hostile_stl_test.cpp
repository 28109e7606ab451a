#include <random>

#include "tests/preprocess/read/stl/stl_samples.h"

namespace farcell::test {
namespace {

// A text of one facet with a part of it replaced.
std::string textWith(const std::string& part, const std::string& replacement) {
  std::string text = textStl({facetAt(0)});
  return text.replace(text.find(part), part.size(), replacement);
}

TEST(HostileStl, RefusesTextThatIsNotOneAndSaysWhere) {
  const TempDirectory directory;
  const std::string facet = textFacet(facetAt(0));
  const std::vector<BadFile> files = {
      {"", "0 bytes"},
      {"solid", "line 2: offset 5: expected 'facet' or 'endsolid', found the end of the file"},
      {"solid x\n", "expected 'facet' or 'endsolid', found the end of the file"},
      {"solid x\n" + facet, "expected 'facet' or 'endsolid', found the end of the file"},
      {"solid x\n" + facet + "endsoli\n", "line 9: offset 102: expected 'facet' or 'endsolid', found 'endsoli'"},
      {"solid x\nendsolid x\nfacet\n", "line 3: offset 19: expected 'solid' or the end of the file, found 'facet'"},
      {"solid x\nendsolid x\nx\n", "expected 'solid' or the end of the file, found 'x'"},
      {"solid x\nvertex 0 0 0\n", "line 2: offset 8: expected 'facet' or 'endsolid', found 'vertex'"},
      {"solid x facet normal 0 0 1\nouter loop\n", "expected 'facet' or 'endsolid', found 'outer'"},
      {textWith("normal", "norma"), "line 2: offset 13: expected 'normal', found 'norma'"},
      {textWith("0 0 1", "0 0"), "expected a number, found 'outer'"},
      {textWith("0 0 1", "0 z 1"), "line 2: offset 13: expected a number, found 'z'"},
      {textWith("0 0 1", "0 0 1 1"), "expected 'outer', found '1'"},
      {textWith("outer ", ""), "line 3: offset 32: expected 'outer', found 'loop'"},
      {textWith("loop", "loops"), "expected 'loop', found 'loops'"},
      {textWith("vertex 0 0 0", "vertex 0 0"), "line 5: offset 57: expected a number, found 'vertex'"},
      {textWith("vertex 0 0 0", "vertex 0 0 0 0"), "expected 'vertex', found '0'"},
      {textWith("vertex 0 0 0", "vertex 0,0 0 0"), "expected a number, found '0,0'"},
      {textWith("vertex 0 0 0", "vertex 0 0 0x1"), "expected a number, found '0x1'"},
      {textWith("  vertex 0 0 0\n", ""), "expected 'vertex', found 'endloop'"},
      {textWith(" endloop\n", "  vertex 1 1 1\n endloop\n"), "expected 'endloop', found 'vertex'"},
      {textWith(" endloop\n", ""), "expected 'endloop', found 'endfacet'"},
      {textWith("endfacet\n", ""), "expected 'endfacet', found 'endsolid'"},
      {textWith("vertex 0 0 0", "vertex 0 0 " + std::string(100'000, '1') + "x"), "expected a number, found '111"},
      {textWith("vertex 0 0 0", "vertex 0 0 \x1b[31m"), "expected a number"},
      {textWith("loop", std::string("lo\0p", 4)), "bytes"},  // a zero early on: a binary file, of another size
      {"solidify\nfacet normal 0 0 1\n" + std::string(60, 'x'), "'solid' at the start, or "},
  };
  for (const BadFile& file : files) expectRefused(directory, "bad.stl", file);
}

std::string resized(const std::string& bytes, size_t size) {
  std::string other = bytes;
  other.resize(size, '\0');
  return other;
}

std::string withCount(uint32_t count) {
  std::string bytes = binaryStl({facetAt(0), facetAt(1)});
  std::memcpy(bytes.data() + 80, &count, sizeof count);
  return bytes;
}

TEST(HostileStl, RefusesBinaryFilesWhoseSizeIsNotWhatTheyAnnounce) {
  const TempDirectory directory;
  const std::string two = binaryStl({facetAt(0), facetAt(1)});
  const std::string solid = binaryStl({facetAt(0), facetAt(1)}, "solid");
  std::vector<BadFile> files;
  for (const size_t size : {1, 4, 79, 80, 83})
    files.push_back({resized(two, size), fmt::format("offset 0: expected 'solid', or a binary STL file of at least 84 "
                                                     "bytes, found {} bytes",
                                                     size)});
  for (const size_t size : {84, 85, 100, 133, 134, 135, 183, 185, 234, 1000})
    files.push_back({resized(two, size),
                     fmt::format("offset 80: expected 'solid' at the start, or 184 bytes for the 2 triangles announced "
                                 "here, found a file of {} bytes",
                                 size)});
  for (const uint32_t count : {0u, 1u, 3u, 1000u, 0x7fffffffu, 0x80000000u, 0xffffffffu})
    files.push_back({withCount(count),
                     fmt::format("or {} bytes for the {} triangles announced here", 84 + 50 * uint64_t{count}, count)});
  for (const size_t size : {84, 183, 185}) files.push_back({resized(solid, size), "184 bytes for the 2 triangles"});
  for (const BadFile& file : files) expectRefused(directory, "bad.stl", file);
}

TEST(HostileStl, IsAnErrorAtEveryTruncation) {
  const TempDirectory directory;
  const std::string text = textStl({facetAt(0), facetAt(1)});
  for (size_t length = 0; length < text.find("endsolid") + 8; ++length)
    expectRefused(directory, "cut.stl", {text.substr(0, length), ""});
  for (const char* header : {"", "solid"}) {
    const std::string binary = binaryStl({facetAt(0), facetAt(1)}, header);
    for (size_t length = 0; length < binary.size(); ++length)
      expectRefused(directory, "cut.stl", {binary.substr(0, length), ""});
  }
}

TEST(HostileStl, SurvivesAnyChangedBytes) {
  const TempDirectory directory;
  constexpr uint32_t kSeed = 1989;
  SCOPED_TRACE(fmt::format("seed {}", kSeed));
  std::mt19937 random(kSeed);
  const std::array<std::string, 2> wholes = {textStl({facetAt(0), facetAt(1)}), binaryStl({facetAt(0), facetAt(1)})};
  int readable = 0;
  for (int round = 0; round < 3000; ++round) {
    std::string bytes = wholes[static_cast<size_t>(round % 2)];
    for (uint32_t i = 0; i <= random() % 4; ++i) bytes[random() % bytes.size()] = static_cast<char>(random());
    readable += readMesh(directory.write("changed.stl", bytes)).has_value();  // checks the counts where it is one
  }
  EXPECT_GT(readable, 100);
}

}  // namespace
}  // namespace farcell::test
