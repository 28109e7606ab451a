#include <gtest/gtest.h>

#include <random>

#include "cache/base/process.h"
#include "tests/preprocess/read/read_support.h"

namespace farcell::test {
namespace {

// A vertex with a list, a quad, a triangle of the common layout and a strip.
std::string sample(Encoding encoding) {
  PlyBody body(encoding);
  for (int i = 0; i < 4; ++i)
    body.put(float(i % 2), float(i / 2), 0.25f, uint8_t(200), uint8_t(100), uint8_t(i)).endRow();
  body.put(uint8_t{2}, int16_t{1}, int16_t{2}).endRow();
  body.put(uint8_t{4}, int32_t{0}, int32_t{1}, int32_t{3}, int32_t{2}).endRow();
  body.put(uint8_t{3}, int32_t{0}, int32_t{1}, int32_t{2}).endRow();
  body.put(int32_t{4}, int32_t{0}, int32_t{1}, int32_t{2}, int32_t{3}).endRow();
  return plyHeader(encoding,
                   "element vertex 4\nproperty float x\nproperty float y\nproperty float z\n"
                   "property uchar red\nproperty uchar green\nproperty uchar blue\n"
                   "element other 1\nproperty list uchar short items\n"
                   "element face 2\nproperty list uchar int vertex_indices\n"
                   "element tristrips 1\nproperty list int int vertex_indices\n") +
         body.bytes();
}

void expectCorrupt(const Result<ReadMesh>& result) {
  ASSERT_FALSE(result);
  EXPECT_EQ(result.error().kind, ErrorKind::corrupt) << result.error().message;
  for (const char* part : {".ply: ", "offset ", "expected ", "found "})
    EXPECT_NE(result.error().message.find(part), std::string::npos) << result.error().message;
}

TEST(HostilePly, IsAnErrorAtEveryTruncation) {
  const TempDirectory directory;
  for (const Encoding encoding : {Encoding::little, Encoding::big, Encoding::ascii}) {
    const std::string whole = sample(encoding);
    EXPECT_EQ(readGood(directory.write("cut.ply", whole)).triangles.size(), 5u);
    // A text may lose its last blank and line end, and then its last digit can become another number.
    const size_t end = encoding == Encoding::ascii ? whole.size() - 3 : whole.size();
    for (size_t length = 0; length < end; ++length) {
      SCOPED_TRACE(fmt::format("{} {}", formatName(encoding), length));
      expectCorrupt(readMesh(directory.write("cut.ply", whole.substr(0, length))));
    }
  }
}

TEST(HostilePly, SurvivesAnyChangedBytes) {
  const TempDirectory directory;
  constexpr uint32_t kSeed = 20240607;
  SCOPED_TRACE(fmt::format("seed {}", kSeed));
  std::mt19937 random(kSeed);
  int readable = 0;
  for (int round = 0; round < 3000; ++round) {
    std::string bytes = sample(static_cast<Encoding>(round % 3));
    for (uint32_t i = 0; i <= random() % 4; ++i) bytes[random() % bytes.size()] = static_cast<char>(random());
    readable += readMesh(directory.write("changed.ply", bytes)).has_value();  // checks the counts where it is one
  }
  EXPECT_GT(readable, 100);
}

std::string withCount(Encoding encoding, const std::string& element, const std::string& count) {
  std::string bytes = sample(encoding);
  const std::string key = "element " + element + " ";
  const size_t at = bytes.find(key) + key.size();
  return bytes.replace(at, bytes.find('\n', at) - at, count);
}

TEST(HostilePly, RefusesCountsTheFileCannotHoldWithoutAllocatingThem) {
  const TempDirectory directory;
  const uint64_t before = peakRssBytes();
  for (const Encoding encoding : {Encoding::little, Encoding::big, Encoding::ascii})
    for (const char* element : {"vertex", "face", "tristrips", "other"})
      for (const char* count : {"1000", "4294967296", "1000000000000", "18446744073709551615"}) {
        SCOPED_TRACE(fmt::format("{} {} {}", formatName(encoding), element, count));
        expectCorrupt(readMesh(directory.write("lie.ply", withCount(encoding, element, count))));
      }
  EXPECT_LT(peakRssBytes() - before, uint64_t{64} << 20);
}

TEST(HostilePly, RefusesCountsThatAreNone) {
  const TempDirectory directory;
  for (const char* count : {"-1", "1.5", "x", "", "99999999999999999999999999", "1 2"})
    expectCorrupt(readMesh(directory.write("count.ply", withCount(Encoding::ascii, "vertex", count))));
}

Result<ReadMesh> readListOf(const TempDirectory& directory, Encoding encoding, int32_t length) {
  PlyBody body(encoding);
  for (int i = 0; i < 3; ++i) body.put(float(i == 1), float(i == 2), 0.f).endRow();
  body.put(length, int32_t{0}, int32_t{1}, int32_t{2}).endRow();
  return readMesh(
      directory.write("list.ply", plyHeader(encoding,
                                            "element vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
                                            "element face 1\nproperty list int int vertex_indices\n") +
                                      body.bytes()));
}

TEST(HostilePly, RefusesListsLongerThanTheFileAndNegativeOnes) {
  const TempDirectory directory;
  for (const Encoding encoding : {Encoding::little, Encoding::big, Encoding::ascii}) {
    EXPECT_TRUE(readListOf(directory, encoding, 3));
    for (const int32_t length : {4, 1000000, INT32_MAX, -1, INT32_MIN})
      expectCorrupt(readListOf(directory, encoding, length));
  }
}

TEST(HostilePly, SaysWhereATextIsWrong) {
  const TempDirectory directory;
  const auto result = readMesh(
      directory.write("word.ply",
                      "ply\nformat ascii 1.0\nelement vertex 2\nproperty float x\nproperty float y\nproperty float z\n"
                      "element face 0\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n0 zero 0\n"));
  ASSERT_FALSE(result);
  EXPECT_NE(result.error().message.find("word.ply: line 11: offset "), std::string::npos) << result.error().message;
  EXPECT_NE(result.error().message.find("row 1 of 2 of element 'vertex'"), std::string::npos) << result.error().message;
  EXPECT_NE(result.error().message.find("found 'zero'"), std::string::npos) << result.error().message;
}

TEST(HostilePly, RefusesHeadersThatMakeNoMesh) {
  const TempDirectory directory;
  const std::string vertex = "element vertex 1\nproperty float x\nproperty float y\nproperty float z\n";
  const std::string face = "element face 0\nproperty list uchar int vertex_indices\n";
  const auto read = [&](const std::string& elements) {
    return readMesh(directory.write("header.ply", plyHeader(Encoding::ascii, elements) + "0 0 0 0 0 0\n"));
  };
  EXPECT_TRUE(read(vertex + face));
  for (const std::string& elements :
       {vertex + vertex + face, face, "property float x\n" + vertex + face, vertex + "property float x\n" + face,
        vertex + "element face 0\nproperty int vertex_indices\n",
        vertex + "element face 0\nproperty list uchar float vertex_indices\n",
        vertex + "element face 0\nproperty list float int vertex_indices\n",
        vertex + "element face 0\nproperty list uchar int corners\n", vertex + "property half w\n" + face,
        "element vertex 1\nproperty float x\nproperty float y\n" + face, vertex + "elephant 1\n" + face})
    expectCorrupt(read(elements));
  const auto cloud = read(vertex);
  ASSERT_FALSE(cloud);
  EXPECT_EQ(cloud.error().kind, ErrorKind::unsupported);
}

TEST(HostilePly, RefusesEmptyFilesAndWrongMagic) {
  const TempDirectory directory;
  expectCorrupt(readMesh(directory.write("empty.ply", "")));
  expectCorrupt(readMesh(directory.write("magic.ply", "plx\nformat ascii 1.0\nend_header\n")));
}

TEST(HostilePly, SkipsElementsWithoutPropertiesWhateverTheirCount) {
  const TempDirectory directory;
  for (const Encoding encoding : {Encoding::little, Encoding::ascii}) {
    std::string bytes = sample(encoding);
    bytes.insert(bytes.find("element face"), "element nothing 18446744073709551615\n");
    EXPECT_EQ(readGood(directory.write("nothing.ply", bytes)).triangles.size(), 5u);
  }
}

}  // namespace
}  // namespace farcell::test
