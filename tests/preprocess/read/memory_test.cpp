// The same triangles in any memory, by every format.
#include <random>

#include "tests/preprocess/read/read_support.h"
#include "tests/support/model_files.h"

namespace farcell::test {
namespace {

constexpr uint64_t kTiny = kLeastReadMemoryBytes;

// A grid of `side` x `side` vertices, its triangles in random order.
IndexedModel shuffledGrid(uint32_t side) {
  IndexedModel model;
  for (uint32_t y = 0; y < side; ++y)
    for (uint32_t x = 0; x < side; ++x)
      model.positions.emplace_back(float(x), float(y) * 0.5f, float(x * y % 17) * 0.25f);
  for (uint32_t y = 0; y + 1 < side; ++y)
    for (uint32_t x = 0; x + 1 < side; ++x) {
      const uint32_t i = y * side + x;
      model.triangles.push_back({i, i + 1, i + side});
      model.triangles.push_back({i + 1, i + side + 1, i + side});
    }
  std::shuffle(model.triangles.begin(), model.triangles.end(), std::mt19937_64(11));
  return model;
}

// With colours and normals, which differ from vertex to vertex.
std::string plyWithAll(const IndexedModel& model, Encoding encoding) {
  PlyBody body(encoding);
  for (size_t i = 0; i < model.positions.size(); ++i) {
    const glm::vec3 p = model.positions[i];
    body.put(double{p.x}, double{p.y}, double{p.z}, uint8_t(i), uint8_t(i / 7), uint8_t(i / 256)).endRow();
    body.put(float(i), 1.0f, -1.0f).endRow();
  }
  for (const auto& t : model.triangles) body.put(uint8_t{3}, int(t[0]), int(t[1]), int(t[2])).endRow();
  return plyHeader(encoding, fmt::format("element vertex {}\nproperty double x\nproperty double y\nproperty double z\n"
                                         "property uchar red\nproperty uchar green\nproperty uchar blue\n"
                                         "property float nx\nproperty float ny\nproperty float nz\n"
                                         "element face {}\nproperty list uchar int vertex_indices\n",
                                         model.positions.size(), model.triangles.size())) +
         body.bytes();
}

std::string objWithAll(const IndexedModel& model) {
  std::string text = "mtllib looks.mtl\nusemtl wall\n";
  for (size_t i = 0; i < model.positions.size(); ++i) {
    const glm::vec3 p = model.positions[i];
    text += fmt::format("v {} {} {} 0.{} 0.5 1\nvt {} 0.{}\nvn {} 1 -1\n", p.x, p.y, p.z, i % 10, i, i % 10, i);
  }
  for (const auto& t : model.triangles)
    text += fmt::format("f {0}/{0}/{0} {1}/{2}/{1} {2}/{1}/{0}\n", t[0] + 1, t[1] + 1, t[2] + 1);
  return text;
}

std::string offWithAll(const IndexedModel& model, bool areBytes) {
  std::string text = fmt::format("CNOFF\n{} {} 0\n", model.positions.size(), model.triangles.size());
  for (size_t i = 0; i < model.positions.size(); ++i) {
    const glm::vec3 p = model.positions[i];
    text += fmt::format("{} {} {} {} 1 -1 {} 1 0\n", p.x, p.y, p.z, i, areBytes ? i % 256 : i % 2);
  }
  for (const auto& t : model.triangles) text += fmt::format("3 {} {} {}\n", t[0], t[1], t[2]);
  return text;
}

struct ReadIn {
  ReadMesh mesh;
  uint64_t peakBytes = 0;
  uint64_t spilledBytes = 0;
};

Result<ReadIn> readIn(const std::filesystem::path& path, const ReadOptions& options) {
  FARCELL_ASSIGN(const std::shared_ptr<ReadMemory> memory, ReadMemory::create(options));
  FARCELL_ASSIGN(const std::unique_ptr<MeshReader> reader, openMeshes({&path, 1}, memory));
  ReadIn in;
  in.mesh.info = reader->info();
  FARCELL_ASSIGN(in.mesh.triangles, collect(*reader, in.mesh.counts));
  in.peakBytes = memory->peakBytes();
  in.spilledBytes = memory->spilledBytes();
  return in;
}

bool sameBits(const InputTriangle& a, const InputTriangle& b) {
  return std::memcmp(&a.positions, &b.positions, sizeof(a.positions)) == 0 && a.colours == b.colours &&
         std::memcmp(&a.normals, &b.normals, sizeof(a.normals)) == 0 && a.texture == b.texture &&
         (a.texture == kNoTexture ||
          std::memcmp(&a.textureCoordinates, &b.textureCoordinates, sizeof(a.textureCoordinates)) == 0);
}

void expectSameInTinyMemory(const std::filesystem::path& path, bool mustSpill) {
  SCOPED_TRACE(path);
  const Result<ReadIn> plenty = readIn(path, {});
  const Result<ReadIn> tiny = readIn(path, {kTiny, {}});
  ASSERT_TRUE(plenty) << plenty.error().message;
  ASSERT_TRUE(tiny) << tiny.error().message;
  ASSERT_GT(plenty->mesh.triangles.size(), 0u);
  ASSERT_EQ(tiny->mesh.triangles.size(), plenty->mesh.triangles.size());
  EXPECT_EQ(tiny->mesh.counts.skipped, plenty->mesh.counts.skipped);
  EXPECT_EQ(tiny->mesh.info.hasColours, plenty->mesh.info.hasColours);
  EXPECT_EQ(tiny->mesh.info.hasNormals, plenty->mesh.info.hasNormals);
  size_t different = 0;
  for (size_t i = 0; i < tiny->mesh.triangles.size(); ++i)
    different += !sameBits(tiny->mesh.triangles[i], plenty->mesh.triangles[i]);
  EXPECT_EQ(different, 0u);
  EXPECT_LE(tiny->peakBytes, kTiny);
  EXPECT_EQ(plenty->spilledBytes, 0u);
  EXPECT_EQ(tiny->spilledBytes > 0, mustSpill);
}

TEST(ReadMemory, TheTrianglesOfEveryFormatAreTheSameInATinyOne) {
  const TempDirectory directory;
  const IndexedModel model = shuffledGrid(90);  // 8,100 vertices: 97 KB as floats, more than the memory
  const ModelFile file(model);
  expectSameInTinyMemory(directory.write("text.ply", file.plyText()), true);
  expectSameInTinyMemory(directory.write("little.ply", file.plyLittle()), false);
  expectSameInTinyMemory(directory.write("big.ply", file.plyBig()), false);
  expectSameInTinyMemory(directory.write("mesh.obj", file.obj()), true);
  expectSameInTinyMemory(directory.write("mesh.off", file.off()), true);
  expectSameInTinyMemory(directory.write("text.stl", file.stlText()), false);
  expectSameInTinyMemory(directory.write("binary.stl", file.stlBinary()), false);
  expectSameInTinyMemory(directory.write("mesh.glb", file.glb()), false);
  expectSameInTinyMemory(directory.write("small.gltf", ModelFile(shuffledGrid(12)).gltf()), false);
}

TEST(ReadMemory, SoAreColoursNormalsAndTextureCoordinates) {
  const TempDirectory directory;
  const IndexedModel model = shuffledGrid(90);
  directory.write("looks.mtl", "newmtl wall\nmap_Kd wall.png\n");
  for (const Encoding encoding : {Encoding::ascii, Encoding::little, Encoding::big})
    expectSameInTinyMemory(directory.write(fmt::format("{}.ply", formatName(encoding)), plyWithAll(model, encoding)),
                           encoding == Encoding::ascii);
  const std::filesystem::path obj = directory.write("all.obj", objWithAll(model));
  expectSameInTinyMemory(obj, true);
  EXPECT_NE(readGood(obj).triangles[0].texture, kNoTexture);
  expectSameInTinyMemory(directory.write("bytes.off", offWithAll(model, true)), true);
  expectSameInTinyMemory(directory.write("units.off", offWithAll(model, false)), true);
}

TEST(ReadMemory, FilesOfASceneShareIt) {
  const TempDirectory directory;
  const IndexedModel model = shuffledGrid(90);
  const ModelFile file(model);
  std::vector<std::filesystem::path> paths;
  for (int i = 0; i < 3; ++i) paths.push_back(directory.write(fmt::format("{}.obj", i), file.obj()));
  const auto memory = ReadMemory::create({kTiny, {}}).value();
  const auto reader = openMeshes(paths, memory);
  ASSERT_TRUE(reader) << reader.error().message;
  MeshCounts counts;
  const auto triangles = collect(**reader, counts);
  ASSERT_TRUE(triangles) << triangles.error().message;
  EXPECT_EQ(triangles->size(), 3u * 2 * 89 * 89);
  EXPECT_LE(memory->peakBytes(), kTiny);
}

TEST(ReadMemory, WhatCannotBePagedAndDoesNotFitIsExhausted) {
  const TempDirectory directory;
  const auto refused = readIn(directory.write("data.gltf", ModelFile(shuffledGrid(90)).gltf()), {kTiny, {}});
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().kind, ErrorKind::exhausted) << refused.error().message;
  EXPECT_NE(refused.error().message.find("data.gltf: "), std::string::npos) << refused.error().message;
}

TEST(ReadMemory, AScratchDirectoryThatCannotBeWrittenIsNamed) {
  const TempDirectory directory;
  const std::filesystem::path scratch = directory.write("file", "not a directory");
  const auto refused = readIn(directory.write("mesh.obj", ModelFile(shuffledGrid(90)).obj()), {kTiny, scratch});
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().kind, ErrorKind::io) << refused.error().message;
  EXPECT_NE(refused.error().message.find(scratch.string()), std::string::npos) << refused.error().message;
}

TEST(ReadMemory, AFileThatShrinksBetweenPassesIsAnError) {
  const TempDirectory directory;
  const IndexedModel model = shuffledGrid(90);
  const ModelFile file(model);
  const std::vector<std::pair<std::string, std::string>> files = {
      {"text.ply", file.plyText()}, {"little.ply", file.plyLittle()}, {"big.ply", file.plyBig()},
      {"mesh.obj", file.obj()},     {"mesh.off", file.off()},         {"text.stl", file.stlText()},
      {"mesh.glb", file.glb()},     {"binary.stl", file.stlBinary()}};
  for (const auto& [name, bytes] : files) {
    SCOPED_TRACE(name);
    for (const uint64_t left : {uint64_t{0}, uint64_t{500}, bytes.size() / 2, bytes.size() - 1}) {
      const std::filesystem::path path = directory.write(name, bytes);
      const auto reader = openMesh(path, {kTiny, {}});
      ASSERT_TRUE(reader) << reader.error().message;
      std::filesystem::resize_file(path, left);
      MeshCounts counts;
      const auto pass = collect(**reader, counts);
      ASSERT_FALSE(pass) << "with " << left << " bytes left";
      EXPECT_NE(pass.error().message.find(name), std::string::npos) << pass.error().message;
    }
  }
}

}  // namespace
}  // namespace farcell::test
