#include "tests/preprocess/read/gltf/gltf_support.h"

namespace farcell::test {
namespace {

constexpr int kStrip = 5;
constexpr int kFan = 6;

// Five vertices of a bent band.
const std::vector<float> kBand = {0, 0, 0, 0, 1, 0, 1, 0, 0.5f, 1, 1, 0.5f, 2, 0, 0};

Corners bandTriangle(size_t a, size_t b, size_t c) { return {pointOf(kBand, a), pointOf(kBand, b), pointOf(kBand, c)}; }

// Whether the two are the same corners in the same sense.
bool areSameTurned(const Corners& a, const Corners& b) {
  return a == b || a == Corners{b[1], b[2], b[0]} || a == Corners{b[2], b[0], b[1]};
}

template <class T>
ReadMesh readIndexed(const std::vector<T>& indices, int mode) {
  GltfWriter writer;
  writer.show({{"attributes", {{"POSITION", writer.addArray("VEC3", kBand)}}},
               {"indices", writer.addArray("SCALAR", indices)},
               {"mode", mode}});
  return readGlb(writer);
}

TEST(GltfGeometry, TrianglesOfEveryIndexTypeAreThoseWritten) {
  const std::vector<Corners> expected = {bandTriangle(0, 2, 1), bandTriangle(3, 1, 2), bandTriangle(4, 3, 2)};
  EXPECT_EQ(positionsOf(readIndexed<uint8_t>({0, 2, 1, 3, 1, 2, 4, 3, 2}, 4)), expected);
  EXPECT_EQ(positionsOf(readIndexed<uint16_t>({0, 2, 1, 3, 1, 2, 4, 3, 2}, 4)), expected);
  EXPECT_EQ(positionsOf(readIndexed<uint32_t>({0, 2, 1, 3, 1, 2, 4, 3, 2}, 4)), expected);
}

TEST(GltfGeometry, StripsTurnEveryOtherTriangle) {
  const ReadMesh mesh = readIndexed<uint16_t>({0, 1, 2, 3, 4}, kStrip);
  EXPECT_EQ(mesh.info.declaredTriangles, 3u);
  ASSERT_EQ(mesh.triangles.size(), 3u);
  EXPECT_TRUE(areSameTurned(mesh.triangles[0].positions, bandTriangle(0, 1, 2)));
  EXPECT_TRUE(areSameTurned(mesh.triangles[1].positions, bandTriangle(1, 3, 2)));
  EXPECT_TRUE(areSameTurned(mesh.triangles[2].positions, bandTriangle(2, 3, 4)));
}

TEST(GltfGeometry, FansTurnAroundTheirFirstCorner) {
  const ReadMesh mesh = readIndexed<uint32_t>({4, 0, 1, 3}, kFan);
  ASSERT_EQ(mesh.triangles.size(), 2u);
  EXPECT_TRUE(areSameTurned(mesh.triangles[0].positions, bandTriangle(0, 1, 4)));
  EXPECT_TRUE(areSameTurned(mesh.triangles[1].positions, bandTriangle(1, 3, 4)));
}

TEST(GltfGeometry, StripsAndFansNeedNoIndices) {
  for (const int mode : {kStrip, kFan}) {
    GltfWriter writer;
    writer.show({{"attributes", {{"POSITION", writer.addArray("VEC3", kBand)}}}, {"mode", mode}});
    const ReadMesh mesh = readGlb(writer);
    ASSERT_EQ(mesh.triangles.size(), 3u);
    EXPECT_TRUE(
        areSameTurned(mesh.triangles[2].positions, mode == kStrip ? bandTriangle(2, 3, 4) : bandTriangle(0, 3, 4)));
  }
}

TEST(GltfGeometry, CornersWithoutIndicesAreTrianglesHoweverMany) {
  constexpr size_t kTriangles = 50000;  // more than one window of vertices
  const std::vector<float> numbers = cornerNumbers(kTriangles);
  GltfWriter writer;
  writer.show({{"attributes", {{"POSITION", writer.addArray("VEC3", numbers)}}}});
  const ReadMesh mesh = readGlb(writer);
  EXPECT_EQ(mesh.info.vertices, 3 * kTriangles);
  ASSERT_EQ(mesh.triangles.size(), kTriangles);
  for (size_t i = 0; i < kTriangles; ++i)
    for (size_t k = 0; k < 3; ++k)
      ASSERT_EQ(mesh.triangles[i].positions[k], pointOf(numbers, 3 * i + k)) << "triangle " << i;
}

TEST(GltfGeometry, ReadsTheSameFromTextWithABufferBesideItAndFromDataUris) {
  const std::vector<float> numbers = cornerNumbers(3);
  GltfWriter writer;
  writer.show({{"attributes", {{"POSITION", writer.addArray("VEC3", numbers)}}}});
  const std::vector<Corners> expected = positionsOf(readGlb(writer));
  ASSERT_EQ(expected.size(), 3u);
  const TempDirectory directory;
  std::filesystem::create_directory(directory.path() / "sub dir");
  const auto buffer = directory.write("sub dir/b\xC3\xA4r.bin", writer.binary());
  const auto text = directory.write("model.gltf", writer.gltf("sub%20dir/b%C3%a4r.bin"));
  EXPECT_EQ(positionsOf(readGood(text)), expected);
  const auto reader = openMesh(text);
  ASSERT_TRUE(reader);
  EXPECT_EQ((*reader)->files(), (std::vector<std::filesystem::path>{text, buffer}));
  const auto embedded = directory.write("data.gltf", writer.gltfWithData());
  EXPECT_EQ(positionsOf(readGood(embedded)), expected);
  EXPECT_EQ((*openMesh(embedded))->files(), std::vector<std::filesystem::path>{embedded});
}

TEST(GltfGeometry, KnowsABinaryFileByItsFirstBytes) {
  GltfWriter writer;
  writer.show({{"attributes", {{"POSITION", writer.addArray("VEC3", kBand)}}}, {"mode", kFan}});
  const TempDirectory directory;
  for (const char* name : {"model", "model.obj", "model.gltf", "MODEL.GLB"})
    EXPECT_EQ(readGood(directory.write(name, writer.glb())).triangles.size(), 3u) << name;
}

TEST(GltfGeometry, FollowsStridesAndOffsets) {
  // Four bytes before, a position and four more bytes for each vertex.
  std::vector<float> numbers(1 + 4 * 5, 7);
  for (size_t i = 0; i < 15; ++i) numbers[1 + i / 3 * 4 + i % 3] = kBand[i];
  GltfWriter writer;
  const uint32_t view = writer.addView(GltfWriter::bytesOf(numbers), {{"byteStride", 16}});
  writer.show(
      {{"attributes",
        {{"POSITION",
          writer.addAccessor(
              {{"bufferView", view}, {"byteOffset", 4}, {"componentType", 5126}, {"count", 5}, {"type", "VEC3"}})}}},
       {"indices", writer.addArray<uint8_t>("SCALAR", {0, 3, 4})}});
  EXPECT_EQ(positionsOf(readGlb(writer)), std::vector<Corners>{bandTriangle(0, 3, 4)});
}

TEST(GltfGeometry, PointsAndLinesAreNotDeclaredAndNeitherIsWhatHasNoPositions) {
  GltfWriter writer;
  const uint32_t positions = writer.addArray("VEC3", kBand);
  for (const int mode : {0, 1, 2, 3}) writer.show({{"attributes", {{"POSITION", positions}}}, {"mode", mode}});
  writer.show({{"attributes", {{"NORMAL", positions}}}});
  writer.show({{"attributes", {{"POSITION", positions}}}, {"mode", kStrip}});
  EXPECT_EQ(readGlb(writer).info.declaredTriangles, 3u);
}

TEST(GltfGeometry, CountsWhatItLeavesOutByReason) {
  std::vector<float> numbers = kBand;
  numbers.insert(numbers.end(), {std::nanf(""), 0, 0, 0, std::numeric_limits<float>::infinity(), 0});
  GltfWriter writer;
  writer.show({{"attributes", {{"POSITION", writer.addArray("VEC3", numbers)}}},
               {"indices", writer.addArray<uint16_t>("SCALAR", {0, 1, 2, 0, 1, 7, 0, 1, 5, 6, 1, 0, 2, 2, 3})}});
  const ReadMesh mesh = readGlb(writer);
  EXPECT_EQ(positionsOf(mesh), std::vector<Corners>{bandTriangle(0, 1, 2)});
  EXPECT_EQ(mesh.counts.skipped,
            (std::map<std::string, uint64_t>{{kSkippedBadIndex, 1}, {kSkippedNonFinite, 2}, {kSkippedZeroArea, 1}}));
}

TEST(GltfGeometry, GivesTheSameTrianglesInEveryPassAndStopsWhenTheSinkFails) {
  GltfWriter writer;
  writer.show({{"attributes", {{"POSITION", writer.addArray("VEC3", cornerNumbers(30000))}}}});
  const TempDirectory directory;
  const auto reader = openMesh(directory.write("model.glb", writer.glb()));
  ASSERT_TRUE(reader);
  MeshCounts counts;
  const auto first = collect(**reader, counts);
  const auto second = collect(**reader, counts);
  ASSERT_TRUE(first && second);
  EXPECT_TRUE(std::equal(first->begin(), first->end(), second->begin(), second->end(), samePositions));
  int calls = 0;
  const auto stopped = (*reader)->forEachTriangle([&](std::span<const InputTriangle>) -> Result<> {
    ++calls;
    return fail(ErrorKind::cancelled, "enough");
  });
  ASSERT_FALSE(stopped);
  EXPECT_EQ(stopped.error().message, "enough");
  EXPECT_EQ(calls, 1);
}

}  // namespace
}  // namespace farcell::test
