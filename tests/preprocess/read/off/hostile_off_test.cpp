#include <random>

#include "cache/base/process.h"
#include "tests/preprocess/read/off/off_samples.h"

namespace farcell::test {
namespace {

constexpr const char* kVertices = "0 0 0\n1 0 0\n0 1 0\n";

// A triangle's file of another face.
BadFile badFace(const std::string& face, const std::string& says) {
  return {std::string("OFF\n3 1 0\n") + kVertices + face + "\n", "line 6: offset 28: expected " + says};
}

BadFile badVertex(const std::string& keyword, const std::string& vertex, const std::string& says) {
  return {keyword + "\n3 1 0\n" + vertex + "\n" + kVertices,
          fmt::format("line 3: offset {}: expected {}", keyword.size() + 7, says)};
}

TEST(HostileOff, RefusesWhatIsNotOneAndSaysWhere) {
  const TempDirectory directory;
  const std::vector<BadFile> files = {
      {"", "line 1: offset 0: expected a header such as 'OFF' or 'COFF', found the end of the file"},
      {"# nothing\n", "line 2: offset 10: expected a header"},
      {"OFFX\n3 1 0\n", "line 1: offset 0: expected a header such as 'OFF' or 'COFF', found 'OFFX'"},
      {"NCOFF\n3 1 0\n", "found 'NCOFF'"},
      {"off\n3 1 0\n", "found 'off'"},
      {"3 1 0\n0 0 0\n", "found '3'"},
      {std::string("\0OFF", 4), "expected a header"},
      {"4OFF\n3 1 0\n", "expected vertices of three coordinates, found 4OFF", ErrorKind::unsupported},
      {"nOFF\n3\n3 1 0\n", "expected vertices of three coordinates, found nOFF", ErrorKind::unsupported},
      {"STCN4nOFF 3 1 0\n", "found STCN4nOFF", ErrorKind::unsupported},
      {"COFF BINARY\n\x01\x02", "expected COFF as text, found COFF BINARY", ErrorKind::unsupported},
      {"OFF\n", "line 2: offset 4: expected the numbers of vertices, faces and edges, found the end of the file"},
      {"OFF\n3\n", "line 2: offset 4: expected the number of faces, found ''"},
      {"OFF\nx 1 0\n", "line 2: offset 4: expected the number of vertices, found 'x'"},
      {"OFF\n3 -1 0\n", "expected the number of faces, found '-1'"},
      {"OFF\n3.0 1 0\n", "expected the number of vertices, found '3.0'"},
      {"OFF 99999999999999999999 1 0\n", "expected the number of vertices, found '99999999999999999999'"},
      {"OFF\n3 1 0\n0 0 0\n1 0 0\n", "expected counts that 12 bytes can hold, found '3 vertices and 1 faces'"},
      {std::string("OFF\n3 1 0\n") + "0.00000 0 0\n1.00000 0 0\n",
       "line 5: offset 34: expected vertex 2 of 3, found the end of the file"},
      {std::string("OFF\n3 2 0\n") + kVertices + "3 0 1 2\n",
       "line 7: offset 36: expected face 1 of 2, found the end of the file"},
      {std::string("OFF\n3 1 0\n") + kVertices + "3 0 1 2\n\n3 0 1 2\n",
       "line 8: offset 37: expected the end of the file after 1 faces, found '3 0 1 2'"},
      badVertex("OFF", "0 0", "a vertex of 3 numbers, found '0 0'"),
      badVertex("OFF", "0 0 0 0", "a vertex of 3 numbers, found '0 0 0 0'"),
      badVertex("OFF", "0 0 zero", "a vertex of numbers, found '0 0 zero'"),
      badVertex("NOFF", "0 0 0", "a vertex of 6 numbers, found"),
      badVertex("NOFF", "0 0 0 1 0 up", "a vertex of numbers, found"),
      badVertex("COFF", "0 0 0", "a vertex of 3 numbers and three or four of a colour, found"),
      badVertex("COFF", "0 0 0 1 1 1 1 1", "a vertex of 3 numbers and three or four of a colour, found"),
      badVertex("COFF", "0 0 0 1 0 red", "a vertex of numbers, found"),
      badVertex("STCNOFF", "1 2 3 4 5 6 7 8 9 10 11 12 13 14 15", "a vertex of 8 numbers"),
      badFace("x 0 1 2", "a face's number of corners, found 'x'"),
      badFace("-3 0 1 2", "a face's number of corners, found '-3'"),
      badFace("3.5 0 1 2", "a face's number of corners, found '3.5'"),
      badFace("4 0 1 2", "4 vertex indices, found '4 0 1 2'"),
      badFace("3 0 1", "3 vertex indices, found '3 0 1'"),
      badFace("3 0 1 two", "3 vertex indices, found '3 0 1 two'"),
      badFace("3 0 1 2.0", "3 vertex indices, found '3 0 1 2.0'"),
      badFace("9223372036854775807 0 1 2", "9223372036854775807 vertex indices"),
      badFace("3 0 1 2 0 0", "after a face nothing, an index into a colour map, or a colour of three or four numbers"),
      badFace("3 0 1 2 0 0 0 0 0", "after a face nothing"),
      badFace("3 0 1 2 0 red 0", "after a face nothing"),
  };
  for (const BadFile& file : files) expectRefused(directory, "bad.off", file);
}

TEST(HostileOff, RefusesCountsTheFileCannotHoldWithoutAllocatingThem) {
  const TempDirectory directory;
  const uint64_t before = peakRssBytes();
  for (const char* counts : {"1000 1", "3 1000", "4294967296 1", "3 4294967296", "1000000000000 0",
                             "9223372036854775807 9223372036854775807", "0 9223372036854775807"})
    expectRefused(directory, "lie.off", {fmt::format("OFF\n{} 0\n{}3 0 1 2\n", counts, kVertices), "counts that"});
  EXPECT_LT(peakRssBytes() - before, uint64_t{16} << 20);
}

TEST(HostileOff, IsAnErrorAtEveryTruncation) {
  const TempDirectory directory;
  // Cut behind the first digit of the last index, the file would be another one.
  const std::string whole = std::string("CNOFF\n3 2 0\n") +
                            "0 0 0 0 0 1 255 0 0 255\n1 0 0 0 0 1 255 0 0 255\n0 1 0 0 0 1 255 0 0 255\n" +
                            "3 0 1 2 9 9 9\n3 0 2 1";
  EXPECT_EQ(readGood(directory.write("cut.off", whole)).triangles.size(), 2u);
  for (size_t length = 0; length < whole.size(); ++length)
    expectRefused(directory, "cut.off", {whole.substr(0, length), ""});
}

TEST(HostileOff, SurvivesAnyChangedBytes) {
  const TempDirectory directory;
  constexpr uint32_t kSeed = 1992;
  SCOPED_TRACE(fmt::format("seed {}", kSeed));
  std::mt19937 random(kSeed);
  const std::string whole = kEveryOff;
  int readable = 0;
  for (int round = 0; round < 3000; ++round) {
    std::string bytes = whole;
    for (uint32_t i = 0; i <= random() % 4; ++i) bytes[random() % bytes.size()] = static_cast<char>(random());
    readable += readMesh(directory.write("changed.off", bytes)).has_value();  // checks the counts where it is one
  }
  EXPECT_GT(readable, 100);
}

}  // namespace
}  // namespace farcell::test
