#include <cmath>

#include "tests/preprocess/read/gltf/gltf_support.h"

namespace farcell::test {
namespace {

const std::vector<float> kTriangle = {0, 0, 0, 1, 0, 0, 0, 2, 0};
// Enough of each kind for what reads it to know it by.
const std::string kPng("\x89PNG\r\n\x1a\n....", 12);
const std::string kJpeg("\xff\xd8\xff\xe0....", 8);

using Rgb = std::array<int, 3>;

// Display values below: 255 times sRGB of the linear value beside them (IEC 61966-2-1), rounded.
// 0.1: 89, 0.125: 99, 0.2: 124, 0.25: 137, 0.4: 170, 0.5: 188, 0.75: 225.

std::array<Rgb, 3> coloursOf(const ReadMesh& mesh) {
  std::array<Rgb, 3> all{};
  for (size_t i = 0; i < 3; ++i) all[i] = channels(mesh.triangles.at(0).colours[i]);
  return all;
}

GltfWriter withFactor(const json& factor) {
  GltfWriter writer;
  writer.add("materials", {{"pbrMetallicRoughness", {{"baseColorFactor", factor}}}});
  writer.show({{"attributes", {{"POSITION", writer.addArray("VEC3", kTriangle)}}}, {"material", 0}});
  return writer;
}

TEST(GltfLook, BaseColoursAreLinearAndBecomeDisplayValues) {
  const ReadMesh mesh = readGlb(withFactor({0.5, 0.1, 1, 0.3}));
  EXPECT_TRUE(mesh.info.hasColours);
  EXPECT_EQ(coloursOf(mesh)[2], (Rgb{188, 89, 255}));
  EXPECT_EQ(coloursOf(readGlb(withFactor({0, 0.002, 0.75, 1})))[0], (Rgb{0, 7, 225}));
}

TEST(GltfLook, WithoutMaterialsAndVertexColoursThereAreNone) {
  GltfWriter writer;
  writer.show({{"attributes", {{"POSITION", writer.addArray("VEC3", kTriangle)}}}});
  EXPECT_FALSE(readGlb(writer).info.hasColours);
  // Beside a coloured one, glTF's default material is white.
  writer.show(
      {{"attributes", {{"POSITION", 0}, {"COLOR_0", writer.addArray<float>("VEC3", std::vector<float>(9, 0.5f))}}}});
  const ReadMesh mesh = readGlb(writer);
  EXPECT_TRUE(mesh.info.hasColours);
  EXPECT_EQ(coloursOf(mesh)[0], (Rgb{255, 255, 255}));
  EXPECT_EQ(channels(mesh.triangles.at(1).colours[0]), (Rgb{188, 188, 188}));
}

template <class T>
std::array<Rgb, 3> vertexColours(const std::string& type, const std::vector<T>& numbers) {
  GltfWriter writer = withFactor({1, 0.5, 1, 1});
  writer.root["meshes"][0]["primitives"][0]["attributes"]["COLOR_0"] =
      writer.addArray(type, numbers, {{"normalized", std::is_integral_v<T>}});
  return coloursOf(readGlb(writer));
}

TEST(GltfLook, VertexColoursOfEveryTypeMultiplyTheFactorInLinearLight) {
  const std::array<Rgb, 3> expected = {{{255, 0, 0}, {137, 99, 137}, {0, 188, 255}}};
  EXPECT_EQ(vertexColours<float>("VEC3", {1, 0, 0, 0.25f, 0.25f, 0.25f, 0, 1, 1}), expected);
  EXPECT_EQ(vertexColours<float>("VEC4", {1, 0, 0, 0.5f, 0.25f, 0.25f, 0.25f, 1, 0, 1, 1, 0}), expected);
  EXPECT_EQ(vertexColours<uint8_t>("VEC4", {255, 0, 0, 9, 64, 64, 64, 9, 0, 255, 255, 9}), expected);
  EXPECT_EQ(vertexColours<uint16_t>("VEC4", {65535, 0, 0, 9, 16384, 16384, 16384, 9, 0, 65535, 65535, 9}), expected);
}

// Three bytes side by side, each vertex at the next multiple of four.
TEST(GltfLook, VertexColoursOfThreeBytesHaveAStride) {
  GltfWriter writer = withFactor({1, 1, 1, 1});
  const uint32_t view = writer.addView(std::string("\xff\0\0\x7f\0\xff\0\x7f\0\0\xff", 11), {{"byteStride", 4}});
  writer.root["meshes"][0]["primitives"][0]["attributes"]["COLOR_0"] = writer.addAccessor(
      {{"bufferView", view}, {"componentType", 5121}, {"count", 3}, {"type", "VEC3"}, {"normalized", true}});
  EXPECT_EQ(coloursOf(readGlb(writer)), (std::array<Rgb, 3>{{{255, 0, 0}, {0, 255, 0}, {0, 0, 255}}}));
}

// A triangle with a texture whose image is in the binary chunk.
GltfWriter textured(const std::vector<float>& coordinates) {
  GltfWriter writer;
  writer.add("images", {{"bufferView", writer.addView(kPng)}, {"mimeType", "image/png"}});
  writer.add("samplers", {{"wrapS", 33071}, {"wrapT", 33648}});
  writer.add("textures", {{"source", 0}, {"sampler", 0}});
  writer.add("materials", {{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}}}});
  writer.show(
      {{"attributes",
        {{"POSITION", writer.addArray("VEC3", kTriangle)}, {"TEXCOORD_0", writer.addArray("VEC2", coordinates)}}},
       {"material", 0}});
  return writer;
}

void expectCoordinates(const ReadMesh& mesh, const std::array<glm::dvec2, 3>& expected, double tolerance) {
  ASSERT_EQ(mesh.triangles.size(), 1u);
  EXPECT_EQ(mesh.triangles[0].texture, 0u);
  for (size_t i = 0; i < 3; ++i) {
    EXPECT_NEAR(mesh.triangles[0].textureCoordinates[i].x, expected[i].x, tolerance);
    EXPECT_NEAR(mesh.triangles[0].textureCoordinates[i].y, expected[i].y, tolerance);
  }
}

TEST(GltfLook, TextureCoordinatesPointUp) {
  const ReadMesh mesh = readGlb(textured({0, 0, 0.25f, 1, 3, -2}));
  EXPECT_TRUE(mesh.info.hasColours);
  expectCoordinates(mesh, {{{0, 1}, {0.25, 0}, {3, 3}}}, 0);
  EXPECT_EQ(coloursOf(mesh)[0], (Rgb{255, 255, 255}));
}

TEST(GltfLook, TextureCoordinatesMayBeNormalisedIntegersOfAnySet) {
  GltfWriter writer = textured({9, 9, 9, 9, 9, 9});
  json& primitive = writer.root["meshes"][0]["primitives"][0];
  primitive["attributes"]["TEXCOORD_3"] =
      writer.addArray<uint16_t>("VEC2", {0, 65535, 13107, 0, 65535, 52428}, {{"normalized", true}});
  writer.root["materials"][0]["pbrMetallicRoughness"]["baseColorTexture"]["texCoord"] = 3;
  expectCoordinates(readGlb(writer), {{{0, 0}, {0.2, 1}, {1, 0.2}}}, 1e-7);
}

TEST(GltfLook, ATextureTransformScalesTurnsAndMovesAndMayNameAnotherSet) {
  GltfWriter writer = textured({9, 9, 9, 9, 9, 9});
  writer.root["meshes"][0]["primitives"][0]["attributes"]["TEXCOORD_1"] =
      writer.addArray<float>("VEC2", {0, 0, 1, 0, 0, 1});
  writer.root["materials"][0]["pbrMetallicRoughness"]["baseColorTexture"]["extensions"]["KHR_texture_transform"] = {
      {"offset", {0.5, 0.25}}, {"rotation", std::acos(0.0)}, {"scale", {2, 3}}, {"texCoord", 1}};
  writer.root["extensionsRequired"] = json::array({"KHR_texture_transform"});
  // A quarter turn counter-clockwise as seen: right becomes up, which is less v in the file; down becomes right.
  // In the file's sense (0.5, 0.25), (0.5, -1.75), (3.5, 0.25).
  expectCoordinates(readGlb(writer), {{{0.5, 0.75}, {0.5, 2.75}, {3.5, 0.75}}}, 1e-6);
}

TEST(GltfLook, AlphaAndSidesAreAsTheMaterialSays) {
  const TempDirectory directory;
  const auto sourceOf = [&](const json& changes) {
    GltfWriter writer = textured({0, 0, 1, 0, 0, 1});
    writer.root["materials"][0].merge_patch(changes);
    const auto reader = openMesh(directory.write("model.glb", writer.glb()));
    EXPECT_TRUE(reader) << reader.error().message;
    return (*reader)->textures()[0];
  };
  const json transparent = {{"baseColorFactor", {1, 1, 1, 0.25}}};
  TextureSource found = sourceOf({{"pbrMetallicRoughness", transparent}});
  EXPECT_EQ(found.surface, (SurfaceKind{.doubleSided = false}));
  EXPECT_EQ(found.opacity, 1) << "opaque materials have no alpha";
  found = sourceOf({{"pbrMetallicRoughness", transparent}, {"alphaMode", "BLEND"}, {"doubleSided", true}});
  EXPECT_EQ(found.surface, (SurfaceKind{.alpha = AlphaMode::blend}));
  EXPECT_EQ(found.opacity, 0.25f);
  EXPECT_EQ(sourceOf({{"alphaMode", "MASK"}}).surface.cutoff, 0.5f);
  EXPECT_EQ(sourceOf({{"alphaMode", "MASK"}, {"alphaCutoff", 0.75}}).surface.cutoff, 0.75f);
  EXPECT_EQ(sourceOf({{"alphaMode", "MASK"}, {"alphaCutoff", -1e300}}).surface.cutoff, 0);
  EXPECT_EQ(sourceOf({{"alphaMode", "MASK"}, {"alphaCutoff", 1e300}}).surface.cutoff, 2);
  const json beyond = {{"pbrMetallicRoughness", {{"baseColorFactor", {1, 1, 1, -7}}}}, {"alphaMode", "BLEND"}};
  EXPECT_EQ(sourceOf(beyond).opacity, 0);
  GltfWriter writer = textured({0, 0, 1, 0, 0, 1});
  writer.root["materials"][0]["alphaMode"] = "SOMETIMES";
  const auto reader = openMesh(directory.write("model.glb", writer.glb()));
  ASSERT_FALSE(reader);
  EXPECT_NE(reader.error().message.find("SOMETIMES"), std::string::npos) << reader.error().message;
}

TEST(GltfLook, WithoutAnImageAMaterialIsATextureWhereItIsNotSeenByAll) {
  const TempDirectory directory;
  GltfWriter writer = textured({0, 0, 1, 0, 0, 1});
  writer.root["materials"][0] = {{"alphaMode", "BLEND"},
                                 {"pbrMetallicRoughness", {{"baseColorFactor", {1, 0, 0, 0.5}}}}};
  const auto reader = openMesh(directory.write("model.glb", writer.glb()));
  ASSERT_TRUE(reader) << reader.error().message;
  ASSERT_EQ((*reader)->textures().size(), 1u);
  EXPECT_EQ((*reader)->textures()[0].surface,
            (SurfaceKind{.hasImage = false, .doubleSided = false, .alpha = AlphaMode::blend}));
  EXPECT_EQ((*reader)->textures()[0].opacity, 0.5f);
  MeshCounts counts;
  EXPECT_EQ(collect(**reader, counts).value().at(0).texture, 0u);
}

TEST(GltfLook, ATextureWithoutCoordinatesOrImageIsNone) {
  GltfWriter writer = textured({0, 0, 1, 0, 0, 1});
  writer.root["materials"][0]["doubleSided"] = true;
  writer.root["meshes"][0]["primitives"][0]["attributes"].erase("TEXCOORD_0");
  EXPECT_EQ(readGlb(writer).triangles.at(0).texture, kNoTexture);
  writer = textured({0, 0, 1, 0, 0, 1});
  writer.root["materials"][0]["doubleSided"] = true;
  writer.root["textures"][0].erase("source");
  EXPECT_EQ(readGlb(writer).triangles.at(0).texture, kNoTexture);
}

TEST(GltfLook, AnImageInABufferIsAPartOfTheFile) {
  const TempDirectory directory;
  const GltfWriter writer = textured({0, 0, 1, 0, 0, 1});
  const std::string bytes = writer.glb();
  const auto path = directory.write("model.glb", bytes);
  const auto reader = openMesh(path);
  ASSERT_TRUE(reader) << reader.error().message;
  ASSERT_EQ((*reader)->textures().size(), 1u);
  const TextureSource& texture = (*reader)->textures()[0];
  EXPECT_EQ(texture.file, path);
  EXPECT_EQ(bytes.substr(texture.offsetBytes, texture.sizeBytes), kPng);
  EXPECT_EQ(texture.wrapU, TextureWrap::clamp);
  EXPECT_EQ(texture.wrapV, TextureWrap::mirror);
  EXPECT_EQ((*reader)->files(), std::vector<std::filesystem::path>{path});
}

std::string textOf(const std::shared_ptr<const std::vector<std::byte>>& bytes) {
  return {reinterpret_cast<const char*>(bytes->data()), bytes->size()};
}

TEST(GltfLook, ImagesMayLieInTextAndInFilesEachNamedOnce) {
  const TempDirectory directory;
  GltfWriter writer = textured({0, 0, 1, 0, 0, 1});
  writer.root["images"].push_back({{"uri", "a%20b.jpg"}});
  writer.root["images"].push_back({{"uri", "data:image/jpeg;base64," + base64(kJpeg)}});
  for (const int source : {1, 1, 2}) {
    writer.add("textures", {{"source", source}});
    writer.add("materials",
               {{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", writer.root["textures"].size() - 1}}}}}});
    json primitive = writer.root["meshes"][0]["primitives"][0];
    primitive["material"] = writer.root["materials"].size() - 1;
    writer.show(primitive);
  }
  const auto image = directory.write("a b.jpg", kJpeg);
  const auto buffer = directory.write("b.bin", writer.binary());
  const auto path = directory.write("model.gltf", writer.gltf("b.bin"));
  const auto reader = openMesh(path);
  ASSERT_TRUE(reader) << reader.error().message;
  EXPECT_EQ((*reader)->files(), (std::vector<std::filesystem::path>{path, buffer, image}));
  const auto textures = (*reader)->textures();
  ASSERT_EQ(textures.size(), 3u);  // the two that are alike are one
  EXPECT_EQ(textures[0].file, buffer);
  EXPECT_EQ(textures[1].file, image);
  EXPECT_EQ(textures[1].sizeBytes, kJpeg.size());
  EXPECT_EQ(textures[1].wrapU, TextureWrap::repeat);
  EXPECT_EQ(textures[2].file, path);
  EXPECT_EQ(textOf(textures[2].embedded), kJpeg);
  std::vector<uint32_t> named;
  for (const InputTriangle& triangle : readGood(path).triangles) named.push_back(triangle.texture);
  EXPECT_EQ(named, (std::vector<uint32_t>{0, 1, 1, 2}));
}

TEST(GltfLook, AnImageInABufferOfTextIsEmbedded) {
  const TempDirectory directory;
  const auto reader = openMesh(directory.write("model.gltf", textured({0, 0, 1, 0, 0, 1}).gltfWithData()));
  ASSERT_TRUE(reader) << reader.error().message;
  ASSERT_EQ((*reader)->textures().size(), 1u);
  EXPECT_EQ(textOf((*reader)->textures()[0].embedded), kPng);
}

TEST(GltfLook, ImagesOfOtherKindsAreRefused) {
  const TempDirectory directory;
  GltfWriter writer = textured({0, 0, 1, 0, 0, 1});
  writer.root["images"][0] = {{"uri", "data:image/webp;base64," + base64("RIFF1234WEBP")}};
  const auto reader = openMesh(directory.write("model.glb", writer.glb()));
  ASSERT_FALSE(reader);
  EXPECT_EQ(reader.error().kind, ErrorKind::unsupported);
  EXPECT_NE(reader.error().message.find("images[0]"), std::string::npos) << reader.error().message;
}

}  // namespace
}  // namespace farcell::test
