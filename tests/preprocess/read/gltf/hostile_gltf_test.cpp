// JSON that lies, is of the wrong kinds, or names what it must not.
#include <sys/stat.h>

#include "cache/base/process.h"
#include "tests/preprocess/read/gltf/hostile_files.h"

namespace farcell::test {
namespace {

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

TEST_F(HostileGltf, TheFileToSpoilIsGood) {
  const ReadMesh mesh = readGood(directory_.write("model.glb", everything().glb()));
  EXPECT_EQ(mesh.info.declaredTriangles, 6u);
  EXPECT_EQ(readGood(directory_.write("model.gltf", everything().gltfWithData())).info.declaredTriangles, 6u);
}

TEST_F(HostileGltf, TextThatIsNoJsonIsRefused) {
  for (const char* text :
       {"", " ", "{", "[1,2", "{\"asset\":}", "nonsense", "{\"asset\":{\"version\":\"2.0\"}}}", "\"\\", "{'a':1}",
        "{\"a\":NaN}", "{\"a\":1e999}", "{\"a\":\"\xff\xfe\"}", "\xff\xd8\xff\xe0"})
    expectError(readText(text), "JSON");
  expectError(readText("[]"), "JSON");
  expectError(readText("{}"), "asset");
}

TEST_F(HostileGltf, DeepAndEndlessJsonIsRefusedBeforeItIsBuilt) {
  for (const char* open : {"[", "{\"a\":"}) {
    std::string text = "{\"asset\":{\"version\":\"2.0\"},\"extras\":";
    for (int i = 0; i < 200000; ++i) text += open;
    expectError(readText(text), "nested");
  }
  std::string text = "{\"extras\":[0";
  for (int i = 0; i < 10000000; ++i) text += ",0";
  expectError(readText(text + "]}"), "JSON values", ErrorKind::exhausted);
}

TEST_F(HostileGltf, OtherVersionsAndRequiredExtensionsAreNamed) {
  expectErrorWith("/asset/version", "1.0", "asset.version", ErrorKind::unsupported);
  expectErrorWith("/asset/version", "3.0", "asset.version", ErrorKind::unsupported);
  expectErrorWith("/asset/version", 2.0, "asset.version");
  expectErrorWith("/asset/minVersion", "2.1", "asset.minVersion", ErrorKind::unsupported);
  expectErrorWith("/extensionsRequired", {"KHR_materials_unlit", "EXT_other"}, "'EXT_other'", ErrorKind::unsupported);
  expectErrorWith("/extensionsRequired", {1}, "extensionsRequired[0]");
  expectErrorWith("/extensionsRequired", "KHR_texture_transform", "extensionsRequired");
}

TEST_F(HostileGltf, ExtensionsThatDoNotMatterMayBeRequired) {
  GltfWriter writer = everything();
  writer.root["extensionsRequired"] = {"KHR_materials_unlit", "KHR_texture_transform", "EXT_meshopt_compression"};
  EXPECT_TRUE(readMesh(directory_.write("model.glb", writer.glb())));
}

TEST_F(HostileGltf, MembersOfTheWrongKindAreRefused) {
  const std::vector<json> notIndices = {"1",        -1,    1.5,    nullptr,   true, json::array(), json::object(),
                                        2147483647, 1e300, -1e300, 4294967296};
  for (const char* at :
       {"/scene", "/scenes/0/nodes/0", "/nodes/0/mesh", "/nodes/2/children/0", "/meshes/0/primitives/0/mode",
        "/meshes/0/primitives/0/indices", "/meshes/0/primitives/0/material",
        "/meshes/0/primitives/0/attributes/POSITION", "/accessors/0/bufferView", "/accessors/0/componentType",
        "/bufferViews/1/buffer", "/bufferViews/1/byteStride", "/accessors/5/sparse/count",
        "/accessors/5/sparse/indices/bufferView", "/textures/0/source", "/images/0/bufferView", "/samplers/0/wrapS",
        "/materials/0/pbrMetallicRoughness/baseColorTexture/index"})
    for (const json& value : notIndices) expectErrorWith(at, value, "an integer of 0 to 2147483646");
  for (const json& value : {json("1"), json(-1), json(0.5), json(nullptr), json(1e30), json(uint64_t{1} << 63)})
    for (const char* at :
         {"/accessors/0/count", "/accessors/0/byteOffset", "/bufferViews/1/byteLength", "/buffers/0/byteLength"})
      expectErrorWith(at, value, "an integer of 0 to");
  for (const char* at :
       {"/asset", "/scenes", "/nodes", "/meshes", "/accessors", "/bufferViews", "/buffers", "/materials", "/scenes/0",
        "/nodes/0", "/meshes/0", "/meshes/0/primitives", "/meshes/0/primitives/0", "/accessors/0",
        "/meshes/0/primitives/0/attributes", "/materials/0/pbrMetallicRoughness", "/accessors/5/sparse/values"})
    expectErrorWith(at, 7, "expected an ");
  expectErrorWith("/nodes/0/translation", {1, 2}, "nodes[0].translation");
  expectErrorWith("/nodes/0/translation", {1, 2, "3"}, "nodes[0].translation[2]");
  expectErrorWith("/nodes/0/matrix", {1, 2}, "nodes[0].matrix");
  expectErrorWith("/materials/0/pbrMetallicRoughness/baseColorFactor", {1, 2, 3}, "baseColorFactor");
  expectErrorWith("/accessors/0/normalized", 1, "accessors[0].normalized");
  expectErrorWith("/accessors/0/type", 3, "accessors[0].type");
  expectErrorWith("/images/0/uri", 3, "images[0].uri");
}

TEST_F(HostileGltf, MissingMembersAreNamed) {
  for (const auto& [object, member] : {std::pair{"/accessors/0", "count"},
                                       {"/accessors/0", "componentType"},
                                       {"/accessors/0", "type"},
                                       {"/bufferViews/0", "buffer"},
                                       {"/bufferViews/0", "byteLength"},
                                       {"/buffers/0", "byteLength"},
                                       {"/meshes/0", "primitives"},
                                       {"/meshes/0/primitives/0", "attributes"},
                                       {"/accessors/5/sparse", "indices"},
                                       {"/asset", "version"},
                                       {"", "asset"}}) {
    GltfWriter writer = everything();
    writer.root[json::json_pointer(object)].erase(member);
    expectError(readMesh(directory_.write("model.glb", writer.glb())), member);
  }
}

TEST_F(HostileGltf, WhatIsNotThereIsRefused) {
  expectErrorWith("/scene", 1, "scene");
  expectErrorWith("/scenes/0/nodes/0", 9, "scenes[0].nodes");
  expectErrorWith("/nodes/0/mesh", 9, "nodes[0].mesh");
  expectErrorWith("/nodes/2/children/0", 9, "nodes[2].children");
  expectErrorWith("/meshes/0/primitives/0/indices", 90, "meshes[0].primitives[0].indices");
  expectErrorWith("/meshes/0/primitives/0/material", 9, "meshes[0].primitives[0].material");
  expectErrorWith("/meshes/0/primitives/0/mode", 7, "meshes[0].primitives[0].mode");
  expectErrorWith("/meshes/0/primitives/0/attributes/NORMAL", 99, "attributes.NORMAL");
  expectErrorWith("/accessors/0/bufferView", 99, "accessors[0].bufferView");
  expectErrorWith("/bufferViews/1/buffer", 1, "bufferViews[1].buffer");
  expectErrorWith("/textures/0/source", 1, "textures[0].source");
  expectErrorWith("/textures/0/sampler", 1, "textures[0].sampler");
  expectErrorWith("/images/0/bufferView", 99, "images[0].bufferView");
  expectErrorWith("/images/0", json::object(), "images[0]");
  expectErrorWith("/samplers/0/wrapS", 9999, "samplers[0].wrapS");
  expectErrorWith("/materials/0/pbrMetallicRoughness/baseColorTexture/index", 1, "baseColorTexture.index");
}

TEST_F(HostileGltf, ExtentsOutsideTheFileAreRefusedHoweverTheyOverflow) {
  for (const uint64_t count :
       {uint64_t{5}, uint64_t{1} << 31, uint64_t{1} << 61, (uint64_t{1} << 63) - 1, 1537228672809129302u})
    expectErrorWith("/accessors/0/count", count, "accessors[0]");
  for (const uint64_t offset : {uint64_t{1}, uint64_t{1} << 32, (uint64_t{1} << 63) - 1}) {
    expectErrorWith("/accessors/0/byteOffset", offset, "accessors[0]");
    expectErrorWith("/bufferViews/1/byteOffset", offset << 20 >> 20 | 1 << 20, "bufferViews[1]");
  }
  expectErrorWith("/bufferViews/1/byteLength", uint64_t{1} << 62, "bufferViews[1]");
  expectErrorWith("/buffers/0/byteLength", uint64_t{1} << 62, "buffers[0].byteLength");
  for (const int stride : {1, 4, 8, 13, 253, 256}) expectErrorWith("/bufferViews/1/byteStride", stride, "byteStride");
  expectErrorWith("/bufferViews/2/byteStride", 4, "byteStride");  // of indices
}

TEST_F(HostileGltf, AccessorsOfTheWrongTypeAreRefused) {
  for (const int type : {0, 5119, 5124, 5125, 5127, 5130})
    expectErrorWith("/accessors/0/componentType", type, "componentType");
  for (const int type : {5120, 5122, 5126})
    expectErrorWith("/accessors/1/componentType", type, "accessors[1].componentType");
  for (const char* type : {"SCALAR", "VEC2", "VEC4", "MAT2", "MAT4"})
    expectErrorWith("/accessors/0/type", type, "accessors[0].type");
  expectErrorWith("/accessors/0/type", "VEC5", "VEC5");
  expectErrorWith("/accessors/2/count", 3, "attributes.NORMAL");        // fewer than positions
  expectErrorWith("/accessors/1/count", 5, "meshes[0].primitives[0]");  // not whole triangles
}

TEST_F(HostileGltf, SparseAccessorsAreCheckedInEveryPart) {
  expectErrorWith("/accessors/5/sparse/count", 5, "accessors[5].sparse");
  expectErrorWith("/accessors/5/sparse/indices/bufferView", 99, "sparse.indices");
  expectErrorWith("/accessors/5/sparse/values/bufferView", 99, "sparse.values");
  expectErrorWith("/accessors/5/sparse/values/bufferView", 0, "sparse.values");
  expectErrorWith("/accessors/5/sparse/indices/byteOffset", 1, "sparse.indices");
  expectErrorWith("/accessors/5/sparse/values/byteOffset", 2147483646, "sparse.values");
  expectErrorWith("/accessors/5/sparse/indices/componentType", 5126, "sparse.indices.componentType");
  expectErrorWith("/accessors/5/count", 3, "sparse.indices");                            // index 3 is none of three
  expectErrorWith("/accessors/5/count", 1 << 30, "accessors[5]", ErrorKind::exhausted);  // zeros without bytes
  for (const std::string& indices : {std::string("\3\1"), std::string("\1\1"), std::string("\xff\xff")}) {
    GltfWriter writer = everything();
    const uint32_t view = writer.addView(indices);
    writer.root["accessors"][5]["sparse"]["indices"]["bufferView"] = view;
    expectError(readMesh(directory_.write("model.glb", writer.glb())), "accessors[5].sparse.indices");
  }
}

TEST_F(HostileGltf, RestartIndicesAreRefused) {
  for (const int mode : {4, 5, 6}) {
    GltfWriter writer;
    const uint32_t positions = writer.addArray("VEC3", cornerNumbers(1));
    writer.show({{"attributes", {{"POSITION", positions}}},
                 {"mode", mode},
                 {"indices", writer.addArray<uint8_t>("SCALAR", {0, 1, 255})}});
    writer.show({{"attributes", {{"POSITION", positions}}},
                 {"mode", mode},
                 {"indices", writer.addArray<uint16_t>("SCALAR", {0, 65535, 1})}});
    writer.show({{"attributes", {{"POSITION", positions}}},
                 {"mode", mode},
                 {"indices", writer.addArray<uint32_t>("SCALAR", {UINT32_MAX, 0, 1})}});
    for (size_t mesh : {0, 1, 2}) {
      writer.root["scenes"][0]["nodes"] = json::array({mesh});
      expectError(readMesh(directory_.write("model.glb", writer.glb())),
                  fmt::format("meshes[{}].primitives[0].indices", mesh));
    }
  }
}

TEST_F(HostileGltf, NodesMustBeTrees) {
  expectErrorWith("/nodes/1/children", {1}, "nodes");              // itself
  expectErrorWith("/nodes/1/children", {2}, "nodes");              // its parent
  expectErrorWith("/nodes/0/children", {1}, "nodes[2].children");  // a second parent
  expectErrorWith("/nodes/0/children", {3, 3}, "nodes[0].children");
  expectErrorWith("/scenes/0/nodes", {0, 1}, "scenes[0].nodes");  // not a root
  expectErrorWith("/nodes/0/matrix", {1, 0, 0, 1, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}, "nodes[0].matrix");
  expectErrorWith("/nodes/2/rotation", {0, 0, 0, 0}, "nodes[2].rotation");
  json chain = json::array();
  for (int i = 0; i < 100000; ++i) chain.push_back({{"children", {i + 1}}});
  chain.push_back(json::object());
  GltfWriter writer;
  writer.root["nodes"] = chain;
  writer.root.erase("buffers");
  expectError(readMesh(directory_.write("model.glb", writer.glb())), "levels", ErrorKind::exhausted);
}

TEST_F(HostileGltf, ACycleThatNoSceneReachesIsOneToo) {
  GltfWriter writer = everything();
  const size_t first = writer.root["nodes"].size();
  for (size_t i = 0; i < 100000; ++i) writer.root["nodes"].push_back({{"children", {first + (i + 1) % 100000}}});
  expectError(readMesh(directory_.write("model.glb", writer.glb())), "cycles");
}

TEST_F(HostileGltf, LimitlessNumbersMakeNoFiniteTriangles) {
  GltfWriter writer = everything();
  writer.root["nodes"][0]["scale"] = {1e308, 1e308, 1e308};
  writer.root["nodes"][0]["translation"] = {1e308, -1e308, 1e308};
  writer.root["nodes"][2]["matrix"] = {1e308, 1e308, 0, 0, 1e308, 1e308, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
  writer.root["materials"][0]["pbrMetallicRoughness"]["baseColorFactor"] = {1e308, -1e308, 0, 0};
  const ReadMesh mesh = readGood(directory_.write("model.glb", writer.glb()));  // checks the counts
  EXPECT_GT(mesh.counts.skipped.at(kSkippedNonFinite), 0u);
}

TEST_F(HostileGltf, NeverGoesOutsideItsDirectoryOrToAnythingButFiles) {
  std::filesystem::create_directory(directory_.path() / "sub");
  ASSERT_EQ(::mkfifo((directory_.path() / "fifo").c_str(), 0600), 0);
  const GltfWriter writer = everything();
  directory_.write("all.bin", writer.binary());
  EXPECT_TRUE(readText(writer.gltf("all.bin")));
  for (const char* uri : {"../all.bin", "sub/./../all.bin", "sub/../../all.bin", "%2e%2e/all.bin", "..%2Fall.bin",
                          "/etc/passwd", "%2Fetc/passwd", "", "all.bin%00", "%zz", "all.bin%2"})
    expectError(readText(writer.gltf(uri)), "buffers[0].uri");
  for (const char* uri : {"file:///etc/passwd", "http://localhost/all.bin", "C:/all.bin"})
    expectError(readText(writer.gltf(uri)), "buffers[0].uri", ErrorKind::unsupported);
  for (const char* uri : {"sub", "fifo", "none.bin"}) {
    const auto result = readText(writer.gltf(uri));
    ASSERT_FALSE(result) << uri;
    EXPECT_NE(result.error().message.find(uri), std::string::npos) << result.error().message;
  }
  GltfWriter images = everything();
  for (const char* uri : {"../a.png", "/dev/zero", "fifo", "sub", "none.png"}) {
    images.root["images"][0] = {{"uri", uri}};
    EXPECT_FALSE(readMesh(directory_.write("model.glb", images.glb()))) << uri;
  }
}

TEST_F(HostileGltf, BadBase64AndShortBuffersAreRefused) {
  const GltfWriter writer = everything();
  for (const std::string& uri :
       {std::string("data:,abc"), std::string("data:application/octet-stream;base64"), std::string("data:;base64,A"),
        std::string("data:;base64,AA*A"), std::string("data:;base64,AAAA AAAA"), std::string("data:;base64,=A==")})
    expectError(readText(writer.gltf(uri)), "buffers[0].uri");
  expectError(readText(writer.gltf("data:;base64," + base64(writer.binary().substr(1)))), "buffers[0].byteLength");
  directory_.write("short.bin", writer.binary().substr(1));
  expectError(readText(writer.gltf("short.bin")), "buffers[0].byteLength");
  expectError(readText(writer.root.dump()), "buffers[0]");  // neither a uri nor a chunk
}

TEST_F(HostileGltf, ClaimsAreNotAllocated) {
  const uint64_t before = peakRssBytes();
  expectErrorWith("/bufferViews/8/extensions/EXT_meshopt_compression/count", uint64_t{1} << 40,
                  "EXT_meshopt_compression");
  expectErrorWith("/accessors/0/count", uint64_t{1} << 40, "accessors[0]");
  GltfWriter writer = everything();
  writer.root["accessors"][0].erase("bufferView");
  writer.root["accessors"][0]["count"] = uint64_t{1} << 40;
  expectError(readMesh(directory_.write("model.glb", writer.glb())), "accessors[0]", ErrorKind::exhausted);
  EXPECT_LT(peakRssBytes() - before, uint64_t{64} << 20);
}

}  // namespace
}  // namespace farcell::test
