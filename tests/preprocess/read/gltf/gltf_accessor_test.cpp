#include "tests/preprocess/read/gltf/gltf_support.h"

namespace farcell::test {
namespace {

const std::vector<float> kTriangle = {0, 0, 0, 1, 0, 0, 0, 2, 0};

json sparse(uint32_t count, uint32_t indices, int indexType, uint32_t values) {
  return {{"count", count},
          {"indices", {{"bufferView", indices}, {"componentType", indexType}}},
          {"values", {{"bufferView", values}}}};
}

TEST(GltfAccessors, SparseValuesReplaceThoseOfTheView) {
  GltfWriter writer;
  const uint32_t positions = writer.addArray("VEC3", kTriangle);
  const uint32_t indices = writer.addView(GltfWriter::bytesOf<uint16_t>({0, 2}));
  const uint32_t values = writer.addView(GltfWriter::bytesOf<float>({5, 6, 7, 8, 9, 10}));
  writer.root["accessors"][positions]["sparse"] = sparse(2, indices, 5123, values);
  writer.show({{"attributes", {{"POSITION", positions}}}});
  EXPECT_EQ(positionsOf(readGlb(writer)), (std::vector<Corners>{{{{5, 6, 7}, {1, 0, 0}, {8, 9, 10}}}}));
}

TEST(GltfAccessors, SparseValuesWithoutAViewReplaceZeros) {
  GltfWriter writer;
  const uint32_t indices = writer.addView(GltfWriter::bytesOf<uint8_t>({1, 3}));
  const uint32_t values = writer.addView(GltfWriter::bytesOf<float>({1, 0, 0, 0, 1, 0}));
  const uint32_t positions = writer.addAccessor(
      {{"componentType", 5126}, {"count", 4}, {"type", "VEC3"}, {"sparse", sparse(2, indices, 5121, values)}});
  writer.show({{"attributes", {{"POSITION", positions}}},
               {"indices", writer.addArray<uint32_t>("SCALAR", {0, 1, 3, 0, 1, 2})}});
  const ReadMesh mesh = readGlb(writer);
  EXPECT_EQ(positionsOf(mesh), (std::vector<Corners>{{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}}}));
  EXPECT_EQ(mesh.counts.skipped.at(kSkippedZeroArea), 1u);
}

TEST(GltfAccessors, IndicesMayBeSparseToo) {
  GltfWriter writer;
  const uint32_t at = writer.addView(GltfWriter::bytesOf<uint32_t>({1, 2}));
  const uint32_t values = writer.addView(GltfWriter::bytesOf<uint16_t>({2, 1}));
  const uint32_t indices = writer.addAccessor(
      {{"componentType", 5123}, {"count", 3}, {"type", "SCALAR"}, {"sparse", sparse(2, at, 5125, values)}});
  writer.show({{"attributes", {{"POSITION", writer.addArray("VEC3", kTriangle)}}}, {"indices", indices}});
  EXPECT_EQ(positionsOf(readGlb(writer)), (std::vector<Corners>{{{{0, 0, 0}, {0, 2, 0}, {1, 0, 0}}}}));
}

// Positions as T, not normalised and normalised, against the numbers divided as the specification says.
template <class T>
void expectQuantised(double full) {
  constexpr T kLeast = std::numeric_limits<T>::min();
  constexpr T kMost = std::numeric_limits<T>::max();
  const std::vector<T> numbers = {0, kLeast, 7, 0, kMost, 0, 0, 3, 0, 11, 5, 0};  // with a pad of one each
  for (const bool normalized : {false, true}) {
    SCOPED_TRACE(fmt::format("{} bytes, normalised {}", sizeof(T), normalized));
    GltfWriter writer;
    const uint32_t view = writer.addView(GltfWriter::bytesOf(numbers), {{"byteStride", 4 * sizeof(T)}});
    writer.show({{"attributes",
                  {{"POSITION", writer.addAccessor({{"bufferView", view},
                                                    {"componentType", GltfWriter::componentType<T>()},
                                                    {"count", 3},
                                                    {"type", "VEC3"},
                                                    {"normalized", normalized}})}}}});
    writer.root["extensionsRequired"] = json::array({"KHR_mesh_quantization"});
    const ReadMesh mesh = readGlb(writer);
    ASSERT_EQ(mesh.triangles.size(), 1u);
    const auto value = [&](T number) { return normalized ? std::max(number / full, -1.0) : double(number); };
    for (size_t i = 0; i < 3; ++i)
      EXPECT_EQ(mesh.triangles[0].positions[i],
                glm::dvec3(value(numbers[4 * i]), value(numbers[4 * i + 1]), value(numbers[4 * i + 2])));
  }
}

TEST(GltfAccessors, QuantisedPositionsAreExact) {
  expectQuantised<int8_t>(127);
  expectQuantised<uint8_t>(255);
  expectQuantised<int16_t>(32767);
  expectQuantised<uint16_t>(65535);
}

TEST(GltfAccessors, QuantisedNormalsAreParts) {
  GltfWriter writer;
  const uint32_t bytes =
      writer.addView(GltfWriter::bytesOf<int8_t>({127, 0, 0, 0, 0, -127, 0, 0, 0, 0, -128, 0}), {{"byteStride", 4}});
  const uint32_t normals = writer.addAccessor(
      {{"bufferView", bytes}, {"componentType", 5120}, {"count", 3}, {"type", "VEC3"}, {"normalized", true}});
  writer.show({{"attributes", {{"POSITION", writer.addArray("VEC3", kTriangle)}, {"NORMAL", normals}}}});
  const InputTriangle triangle = readGlb(writer).triangles.at(0);
  EXPECT_EQ(triangle.normals[0], glm::vec3(1, 0, 0));
  EXPECT_EQ(triangle.normals[1], glm::vec3(0, -1, 0));
  EXPECT_EQ(triangle.normals[2], glm::vec3(0, 0, -1));
}

TEST(GltfAccessors, QuantisedTextureCoordinatesMayBeTexels) {
  GltfWriter writer;
  writer.add("images", {{"bufferView", writer.addView("\x89PNG")}});
  writer.add("textures", {{"source", 0}});
  writer.add("materials",
             {{"pbrMetallicRoughness",
               {{"baseColorTexture",
                 {{"index", 0}, {"extensions", {{"KHR_texture_transform", {{"scale", {0.25, 0.125}}}}}}}}}}});
  const uint32_t texels = writer.addArray<int8_t>("VEC2", {0, 0, 1, 2, -4, 8, 0, 0});
  writer.root["accessors"][texels]["count"] = 3;
  writer.show(
      {{"attributes", {{"POSITION", writer.addArray("VEC3", kTriangle)}, {"TEXCOORD_0", texels}}}, {"material", 0}});
  const InputTriangle triangle = readGlb(writer).triangles.at(0);
  EXPECT_EQ(triangle.textureCoordinates[1], glm::vec2(0.25f, 0.75f));
  EXPECT_EQ(triangle.textureCoordinates[2], glm::vec2(-1, 0));
}

TEST(GltfAccessors, PrimitivesMayShareVerticesAndDifferInColour) {
  GltfWriter writer;
  for (const double red : {0.0, 0.5, 1.0})
    writer.add("materials", {{"pbrMetallicRoughness", {{"baseColorFactor", {red, 0, 0, 1}}}}});
  const uint32_t positions = writer.addArray("VEC3", kTriangle);
  const uint32_t colours = writer.addArray<float>("VEC3", std::vector<float>(9, 0.5f));
  const uint32_t indices = writer.addArray<uint16_t>("SCALAR", {0, 1, 2});
  for (int i = 0; i < 3; ++i)
    writer.show({{"attributes", {{"POSITION", positions}}}, {"indices", indices}, {"material", i}});
  writer.show({{"attributes", {{"POSITION", positions}, {"COLOR_0", colours}}}, {"indices", indices}, {"material", 2}});
  std::vector<int> reds;
  for (const InputTriangle& triangle : readGlb(writer).triangles) reds.push_back(channels(triangle.colours[0])[0]);
  EXPECT_EQ(reds, (std::vector<int>{0, 188, 255, 188}));
}

}  // namespace
}  // namespace farcell::test
