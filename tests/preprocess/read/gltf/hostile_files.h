// Good glTF files of many features at once, for tests that spoil them.
#pragma once

#include <meshoptimizer.h>

#include "tests/preprocess/read/gltf/gltf_support.h"

namespace farcell::test {

// Two nodes, a textured mesh with indices, normals and colours, one with sparse positions and one in a compressed view.
inline GltfWriter everything() {
  GltfWriter writer;
  const std::vector<float> square = {0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 1};
  writer.add("images",
             {{"bufferView", writer.addView(std::string("\x89PNG\r\n\x1a\n", 8))}, {"mimeType", "image/png"}});
  writer.add("samplers", {{"wrapS", 33071}});
  writer.add("textures", {{"source", 0}, {"sampler", 0}});
  writer.add(
      "materials",
      {{"pbrMetallicRoughness",
        {{"baseColorFactor", {1, 0.5, 0.25, 1}},
         {"baseColorTexture", {{"index", 0}, {"extensions", {{"KHR_texture_transform", {{"rotation", 1}}}}}}}}}});
  const uint32_t positions = writer.addArray("VEC3", square);
  const uint32_t indices = writer.addArray<uint16_t>("SCALAR", {0, 1, 2, 2, 1, 3});
  writer.show({{"attributes",
                {{"POSITION", positions},
                 {"NORMAL", writer.addArray("VEC3", square)},
                 {"COLOR_0", writer.addArray<uint8_t>("VEC4", std::vector<uint8_t>(16, 99), {{"normalized", true}})},
                 {"TEXCOORD_0", writer.addArray<float>("VEC2", {0, 0, 1, 0, 0, 1, 1, 1})}}},
               {"indices", indices},
               {"material", 0}});
  const uint32_t at = writer.addView(std::string("\1\3", 2));
  const uint32_t values = writer.addView(GltfWriter::bytesOf<float>({1, 0, 0, 0, 1, 0}));
  const uint32_t sparse = writer.addAccessor({{"componentType", 5126},
                                              {"count", 4},
                                              {"type", "VEC3"},
                                              {"sparse",
                                               {{"count", 2},
                                                {"indices", {{"bufferView", at}, {"componentType", 5121}}},
                                                {"values", {{"bufferView", values}}}}}});
  writer.addNode(
      {{"children",
        {writer.add("nodes", {{"mesh", writer.addMesh({{"attributes", {{"POSITION", sparse}}}, {"mode", 5}})}})}},
       {"rotation", {0, 0, 0.6, 0.8}}});
  std::string code(meshopt_encodeVertexBufferBound(4, 12), '\0');
  code.resize(
      meshopt_encodeVertexBuffer(reinterpret_cast<unsigned char*>(code.data()), code.size(), square.data(), 4, 12));
  const uint32_t coded = writer.addView(code);
  json& view = writer.root["bufferViews"][coded];
  view["extensions"]["EXT_meshopt_compression"] = {{"buffer", 0},
                                                   {"byteOffset", view["byteOffset"]},
                                                   {"byteLength", code.size()},
                                                   {"byteStride", 12},
                                                   {"count", 4},
                                                   {"mode", "ATTRIBUTES"}};
  view["byteLength"] = 48;
  const uint32_t decoded =
      writer.addAccessor({{"bufferView", coded}, {"componentType", 5126}, {"count", 4}, {"type", "VEC3"}});
  writer.show({{"attributes", {{"POSITION", decoded}}}, {"mode", 6}});
  return writer;
}

class HostileGltf : public ::testing::Test {
 protected:
  Result<ReadMesh> readText(const std::string& text) const { return readMesh(directory_.write("model.gltf", text)); }
  // The error must say which file, where in it, and what was expected.
  void expectError(const Result<ReadMesh>& result, const std::string& where,
                   ErrorKind kind = ErrorKind::corrupt) const {
    ASSERT_FALSE(result) << where;
    EXPECT_EQ(result.error().kind, kind) << result.error().message;
    for (const std::string& part : {std::string("model.gl"), where, std::string("expected"), std::string("found")})
      EXPECT_NE(result.error().message.find(part), std::string::npos) << result.error().message << "\nlacks " << part;
  }
  // everything(), with the JSON pointer `at` set to `value`.
  void expectErrorWith(const std::string& at, const json& value, const std::string& where,
                       ErrorKind kind = ErrorKind::corrupt) const {
    SCOPED_TRACE(at + " = " + value.dump());
    GltfWriter writer = everything();
    writer.root[json::json_pointer(at)] = value;
    expectError(readMesh(directory_.write("model.glb", writer.glb())), where, kind);
  }
  const TempDirectory directory_;
};

}  // namespace farcell::test
