// Accessors, views and buffers that are not where or what they say, or must not be opened.
#include <sys/stat.h>

#include "cache/base/process.h"
#include "tests/preprocess/read/gltf/hostile_files.h"

namespace farcell::test {
namespace {

using HostileGltfBytes = HostileGltf;

TEST_F(HostileGltfBytes, ExtentsOutsideTheFileAreRefusedHoweverTheyOverflow) {
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

TEST_F(HostileGltfBytes, AccessorsOfTheWrongTypeAreRefused) {
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

TEST_F(HostileGltfBytes, SparseAccessorsAreCheckedInEveryPart) {
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

TEST_F(HostileGltfBytes, RestartIndicesAreRefused) {
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

TEST_F(HostileGltfBytes, NeverGoesOutsideItsDirectoryOrToAnythingButFiles) {
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

TEST_F(HostileGltfBytes, BadBase64AndShortBuffersAreRefused) {
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

TEST_F(HostileGltfBytes, ClaimsAreNotAllocated) {
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
