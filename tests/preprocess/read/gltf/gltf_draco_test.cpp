#include <random>

#include "tests/preprocess/read/gltf/gltf_support.h"
#include "tests/support/sanitized.h"

#ifdef FARCELL_HAS_DRACO
#include <draco/compression/encode.h>
#include <draco/mesh/triangle_soup_mesh_builder.h>
#endif

namespace farcell::test {
namespace {

// What Draco has to be given beside its bytes.
struct Coded {
  std::string bytes;
  size_t points = 0;
  size_t faces = 0;
};

// A primitive whose accessors have no bytes of their own.
GltfWriter dracoFile(const Coded& coded) {
  GltfWriter writer;
  const uint32_t view = writer.addView(coded.bytes);
  const uint32_t positions = writer.addAccessor({{"componentType", 5126}, {"count", coded.points}, {"type", "VEC3"}});
  const uint32_t colours =
      writer.addAccessor({{"componentType", 5121}, {"count", coded.points}, {"type", "VEC4"}, {"normalized", true}});
  const uint32_t indices =
      writer.addAccessor({{"componentType", 5125}, {"count", 3 * coded.faces}, {"type", "SCALAR"}});
  writer.show(
      {{"attributes", {{"POSITION", positions}, {"COLOR_0", colours}}},
       {"indices", indices},
       {"extensions",
        {{"KHR_draco_mesh_compression", {{"bufferView", view}, {"attributes", {{"POSITION", 0}, {"COLOR_0", 1}}}}}}}});
  writer.root["extensionsRequired"] = json::array({"KHR_draco_mesh_compression"});
  return writer;
}

#ifdef FARCELL_HAS_DRACO

// Triangles with a position and a colour for each corner.
struct Soup {
  std::vector<float> positions;
  std::vector<std::array<uint8_t, 4>> colours;
};

Soup soup(size_t triangles) {
  Soup made{cornerNumbers(triangles), {}};
  for (size_t i = 0; i < 3 * triangles; ++i) made.colours.push_back({uint8_t(i % 3 * 127), 255, 0, 255});
  return made;
}

Coded encode(const Soup& input, int method) {
  draco::TriangleSoupMeshBuilder builder;
  const size_t faces = input.colours.size() / 3;
  builder.Start(static_cast<int>(faces));
  const int position = builder.AddAttribute(draco::GeometryAttribute::POSITION, 3, draco::DT_FLOAT32);
  const int colour = builder.AddAttribute(draco::GeometryAttribute::COLOR, 4, draco::DT_UINT8);
  for (size_t i = 0; i < faces; ++i) {
    const draco::FaceIndex face(static_cast<uint32_t>(i));
    const float* p = input.positions.data() + 9 * i;
    const auto* c = input.colours.data() + 3 * i;
    builder.SetAttributeValuesForFace(position, face, p, p + 3, p + 6);
    builder.SetAttributeValuesForFace(colour, face, c[0].data(), c[1].data(), c[2].data());
  }
  const std::unique_ptr<draco::Mesh> mesh = builder.Finalize();
  draco::Encoder encoder;
  encoder.SetEncodingMethod(method);
  encoder.SetTrackEncodedProperties(true);
  encoder.SetAttributeQuantization(draco::GeometryAttribute::POSITION, 16);
  draco::EncoderBuffer buffer;
  EXPECT_TRUE(encoder.EncodeMeshToBuffer(*mesh, &buffer).ok());
  return {std::string(buffer.data(), buffer.size()), encoder.num_encoded_points(), encoder.num_encoded_faces()};
}

TEST(GltfDraco, DecodesBothMethods) {
  const Soup input = soup(100);
  for (const int method : {draco::MESH_SEQUENTIAL_ENCODING, draco::MESH_EDGEBREAKER_ENCODING}) {
    const ReadMesh mesh = readGlb(dracoFile(encode(input, method)));
    ASSERT_EQ(mesh.triangles.size(), 100u);
    // Neither the order of triangles nor which corner is first is kept: a colour and a position belong together.
    std::vector<bool> found(100, false);
    for (const InputTriangle& triangle : mesh.triangles) {
      size_t first = 0;  // the corner whose red is 0
      while (first < 2 && channels(triangle.colours[first])[0] != 0) ++first;
      const auto number = static_cast<size_t>(triangle.positions[first].x + 0.25);
      ASSERT_LT(number, 100u);
      found[number] = true;
      for (size_t k = 0; k < 3; ++k)
        expectNear(triangle.positions[(first + k) % 3], pointOf(input.positions, 3 * number + k), 200.0 / 65535);
    }
    EXPECT_EQ(std::count(found.begin(), found.end(), true), 100);
  }
}

TEST(GltfDraco, RefusesCountsOtherThanTheCodedOnes) {
  const TempDirectory directory;
  const Coded good = encode(soup(10), draco::MESH_EDGEBREAKER_ENCODING);
  for (const auto& [points, faces] : {std::pair<size_t, size_t>{good.points + 1, good.faces},
                                      {good.points, good.faces + 1},
                                      {good.points, 0},
                                      {0, good.faces},
                                      {size_t{1} << 40, size_t{1} << 40}}) {
    const auto result = readMesh(directory.write("model.glb", dracoFile({good.bytes, points, faces}).glb()));
    ASSERT_FALSE(result) << points << " " << faces;
    EXPECT_NE(result.error().message.find("KHR_draco_mesh_compression: expected"), std::string::npos)
        << result.error().message;
  }
}

TEST(GltfDraco, RefusesGarbageAndEveryTruncation) {
  const TempDirectory directory;
  for (const int method : {draco::MESH_SEQUENTIAL_ENCODING, draco::MESH_EDGEBREAKER_ENCODING}) {
    const Coded good = encode(soup(10), method);
    for (size_t length = 0; length < good.bytes.size(); length += kSanitized ? 5 : 1) {
      const auto result = readMesh(
          directory.write("model.glb", dracoFile({good.bytes.substr(0, length), good.points, good.faces}).glb()));
      ASSERT_FALSE(result) << length;
      EXPECT_NE(result.error().message.find("expected"), std::string::npos) << result.error().message;
    }
    EXPECT_FALSE(
        readMesh(directory.write("model.glb", dracoFile({std::string(500, 'x'), good.points, good.faces}).glb())));
  }
}

TEST(GltfDraco, SurvivesAnyChangedBytes) {
  const TempDirectory directory;
  constexpr uint32_t kSeed = 20240613;
  SCOPED_TRACE(fmt::format("seed {}", kSeed));
  std::mt19937 random(kSeed);
  for (const int method : {draco::MESH_SEQUENTIAL_ENCODING, draco::MESH_EDGEBREAKER_ENCODING}) {
    const Coded good = encode(soup(20), method);
    for (int round = 0; round < fuzzRounds(); ++round) {
      Coded changed = good;
      for (uint32_t i = 0; i <= random() % 3; ++i)
        changed.bytes[random() % good.bytes.size()] = static_cast<char>(random());
      const auto result = readMesh(directory.write("model.glb", dracoFile(changed).glb()));  // checks the counts
      const std::string message = result ? "expected" : result.error().message;
      EXPECT_NE(message.find("expected"), std::string::npos) << message;
    }
  }
}

#else

TEST(GltfDraco, IsNamedWhereTheBuildHasNone) {
  const TempDirectory directory;
  GltfWriter writer = dracoFile({"DRACO", 3, 1});
  for (const bool isRequired : {true, false}) {
    if (!isRequired) writer.root.erase("extensionsRequired");
    const auto result = readMesh(directory.write("model.glb", writer.glb()));
    ASSERT_FALSE(result);
    EXPECT_EQ(result.error().kind, ErrorKind::unsupported);
    EXPECT_NE(result.error().message.find("KHR_draco_mesh_compression"), std::string::npos) << result.error().message;
  }
}

#endif

}  // namespace
}  // namespace farcell::test
