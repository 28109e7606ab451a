// JSON that lies or is of the wrong kinds.
#include "tests/preprocess/read/gltf/hostile_files.h"

namespace farcell::test {
namespace {

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

}  // namespace
}  // namespace farcell::test
