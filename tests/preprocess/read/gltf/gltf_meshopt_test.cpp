#include <meshoptimizer.h>

#include <cmath>

#include "tests/preprocess/read/gltf/gltf_support.h"

namespace farcell::test {
namespace {

constexpr uint32_t kSide = 40;  // vertices along a grid's edge

struct GridMesh {
  std::vector<float> positions;
  std::vector<uint32_t> indices;
};

GridMesh grid() {
  GridMesh mesh;
  for (size_t i = 0; i < kSide * kSide; ++i)
    mesh.positions.insert(mesh.positions.end(), {float(i % kSide), float(i / kSide), std::sin(float(i))});
  for (uint32_t y = 0; y + 1 < kSide; ++y)
    for (uint32_t x = 0; x + 1 < kSide; ++x) {
      const uint32_t a = y * kSide + x;
      const uint32_t b = a + kSide;
      mesh.indices.insert(mesh.indices.end(), {a, a + 1, b, b, a + 1, b + 1});
    }
  return mesh;
}

std::string vertexCode(const std::string& vertices, size_t stride) {
  const size_t count = vertices.size() / stride;
  std::string code(meshopt_encodeVertexBufferBound(count, stride), '\0');
  code.resize(meshopt_encodeVertexBuffer(reinterpret_cast<unsigned char*>(code.data()), code.size(), vertices.data(),
                                         count, stride));
  return code;
}

std::string triangleCode(const std::vector<uint32_t>& indices, size_t vertices) {
  std::string code(meshopt_encodeIndexBufferBound(indices.size(), vertices), '\0');
  code.resize(meshopt_encodeIndexBuffer(reinterpret_cast<unsigned char*>(code.data()), code.size(), indices.data(),
                                        indices.size()));
  return code;
}

std::string sequenceCode(const std::vector<uint32_t>& indices, size_t vertices) {
  std::string code(meshopt_encodeIndexSequenceBound(indices.size(), vertices), '\0');
  code.resize(meshopt_encodeIndexSequence(reinterpret_cast<unsigned char*>(code.data()), code.size(), indices.data(),
                                          indices.size()));
  return code;
}

struct Coding {
  std::string mode;
  size_t stride;
  size_t count;
  std::string filter = "NONE";
};

// A view of a fallback buffer without bytes, coded as `code` in the real one.
uint32_t addCoded(GltfWriter& writer, const std::string& code, const Coding& coding) {
  if (writer.root["buffers"].size() == 1)
    writer.root["buffers"].push_back(
        {{"byteLength", 1 << 24}, {"extensions", {{"EXT_meshopt_compression", {{"fallback", true}}}}}});
  const uint32_t view = writer.addView(code);
  json& object = writer.root["bufferViews"][view];
  json extension = {{"buffer", 0},
                    {"byteOffset", object["byteOffset"]},
                    {"byteLength", code.size()},
                    {"byteStride", coding.stride},
                    {"count", coding.count},
                    {"mode", coding.mode},
                    {"filter", coding.filter}};
  object = {{"buffer", 1},
            {"byteLength", coding.stride * coding.count},
            {"extensions", {{"EXT_meshopt_compression", extension}}}};
  if (coding.mode == "ATTRIBUTES") object["byteStride"] = coding.stride;
  writer.root["extensionsRequired"] = json::array({"EXT_meshopt_compression", "KHR_mesh_quantization"});
  return view;
}

uint32_t addAccessor(GltfWriter& writer, uint32_t view, int componentType, const char* type, size_t count) {
  return writer.addAccessor({{"bufferView", view},
                             {"componentType", componentType},
                             {"count", count},
                             {"type", type},
                             {"normalized", componentType < 5123}});
}

uint32_t addPositions(GltfWriter& writer, const std::vector<float>& positions) {
  const size_t count = positions.size() / 3;
  const uint32_t view = addCoded(writer, vertexCode(GltfWriter::bytesOf(positions), 12), {"ATTRIBUTES", 12, count});
  return addAccessor(writer, view, 5126, "VEC3", count);
}

using Sorted = std::vector<std::array<std::array<double, 3>, 3>>;

// The coder may turn a triangle's corners round and keeps the order of triangles: each as from its least corner.
Sorted fromLeast(const std::vector<Corners>& triangles) {
  Sorted all;
  for (const Corners& corners : triangles) {
    std::array<std::array<double, 3>, 3> points{};
    for (size_t i = 0; i < 3; ++i) points[i] = {corners[i].x, corners[i].y, corners[i].z};
    std::rotate(points.begin(), std::min_element(points.begin(), points.end()), points.end());
    all.push_back(points);
  }
  return all;
}

std::vector<Corners> expectedTriangles(const GridMesh& mesh) {
  std::vector<Corners> expected;
  for (size_t i = 0; i < mesh.indices.size(); i += 3)
    expected.push_back({pointOf(mesh.positions, mesh.indices[i]), pointOf(mesh.positions, mesh.indices[i + 1]),
                        pointOf(mesh.positions, mesh.indices[i + 2])});
  return expected;
}

TEST(GltfMeshopt, DecodesVerticesAndTrianglesOfBothIndexSizes) {
  const GridMesh mesh = grid();
  for (const size_t indexBytes : {2, 4}) {
    GltfWriter writer;
    const uint32_t positions = addPositions(writer, mesh.positions);
    const uint32_t view =
        addCoded(writer, triangleCode(mesh.indices, kSide * kSide), {"TRIANGLES", indexBytes, mesh.indices.size()});
    writer.show({{"attributes", {{"POSITION", positions}}},
                 {"indices", addAccessor(writer, view, indexBytes == 2 ? 5123 : 5125, "SCALAR", mesh.indices.size())}});
    EXPECT_EQ(fromLeast(positionsOf(readGlb(writer))), fromLeast(expectedTriangles(mesh)));
  }
}

TEST(GltfMeshopt, DecodesSequencesOfIndices) {
  const GridMesh mesh = grid();
  std::vector<uint32_t> strip;
  for (uint32_t x = 0; x < kSide; ++x) strip.insert(strip.end(), {x, x + kSide});
  GltfWriter writer;
  const uint32_t positions = addPositions(writer, mesh.positions);
  const uint32_t view = addCoded(writer, sequenceCode(strip, kSide * kSide), {"INDICES", 2, strip.size()});
  writer.show({{"attributes", {{"POSITION", positions}}},
               {"mode", 5},
               {"indices", addAccessor(writer, view, 5123, "SCALAR", strip.size())}});
  const ReadMesh read = readGlb(writer);
  ASSERT_EQ(read.triangles.size(), strip.size() - 2);
  EXPECT_EQ(read.triangles[0].positions,
            (Corners{pointOf(mesh.positions, 0), pointOf(mesh.positions, kSide), pointOf(mesh.positions, 1)}));
}

TEST(GltfMeshopt, UndoesTheOctahedralFilter) {
  const std::vector<float> normals = {0.6f, 0, 0.8f, 0, 0, -0.6f, -0.8f, 0, 0, 1, 0, 0};
  for (const size_t stride : {4, 8}) {
    std::string filtered(3 * stride, '\0');
    meshopt_encodeFilterOct(filtered.data(), 3, stride, stride == 4 ? 8 : 12, normals.data());
    GltfWriter writer;
    const uint32_t view = addCoded(writer, vertexCode(filtered, stride), {"ATTRIBUTES", stride, 3, "OCTAHEDRAL"});
    writer.show({{"attributes",
                  {{"POSITION", writer.addArray<float>("VEC3", {0, 0, 0, 1, 0, 0, 0, 2, 0})},
                   {"NORMAL", addAccessor(writer, view, stride == 4 ? 5120 : 5122, "VEC3", 3)}}}});
    const InputTriangle triangle = readGlb(writer).triangles.at(0);
    for (size_t i = 0; i < 3; ++i)
      expectNear(glm::normalize(glm::dvec3(triangle.normals[i])),
                 glm::dvec3(normals[4 * i], normals[4 * i + 1], normals[4 * i + 2]), stride == 4 ? 0.02 : 0.002);
  }
}

TEST(GltfMeshopt, UndoesTheExponentialFilter) {
  const std::vector<float> positions = {0, 0.001f, 1000, -3.25f, 7e-5f, 12, 5, 6, -7e5f};
  std::string filtered(36, '\0');
  meshopt_encodeFilterExp(filtered.data(), 3, 12, 20, positions.data());
  GltfWriter writer;
  const uint32_t view = addCoded(writer, vertexCode(filtered, 12), {"ATTRIBUTES", 12, 3, "EXPONENTIAL"});
  writer.show({{"attributes", {{"POSITION", addAccessor(writer, view, 5126, "VEC3", 3)}}}});
  const InputTriangle triangle = readGlb(writer).triangles.at(0);
  // 20 bits for the largest of each vertex.
  for (size_t i = 0; i < 3; ++i) expectNear(triangle.positions[i], pointOf(positions, i), 7e5 / (1 << 18));
}

TEST(GltfMeshopt, UndoesTheQuaternionFilterOfInstances) {
  const auto half = float(std::sqrt(0.5));
  const std::vector<float> turns = {0, 0, 0, 1, half, 0, 0, half};
  std::string filtered(16, '\0');
  meshopt_encodeFilterQuat(filtered.data(), 2, 8, 16, turns.data());
  GltfWriter writer;
  const uint32_t view = addCoded(writer, vertexCode(filtered, 8), {"ATTRIBUTES", 8, 2, "QUATERNION"});
  writer.addMesh({{"attributes", {{"POSITION", writer.addArray<float>("VEC3", {0, 0, 0, 1, 0, 0, 0, 2, 0})}}}});
  const uint32_t rotations = addAccessor(writer, view, 5122, "VEC4", 2);
  writer.addNode(
      {{"mesh", 0}, {"extensions", {{"EXT_mesh_gpu_instancing", {{"attributes", {{"ROTATION", rotations}}}}}}}});
  const ReadMesh mesh = readGlb(writer);
  ASSERT_EQ(mesh.triangles.size(), 2u);
  expectNear(mesh.triangles[0].positions[2], {0, 2, 0}, 1e-3);
  expectNear(mesh.triangles[1].positions[2], {0, 0, 2}, 1e-3);  // a quarter turn about x
}

TEST(GltfMeshopt, RefusesGarbageAndCountsThatTheBytesCannotHold) {
  const GridMesh mesh = grid();
  GltfWriter writer;
  const uint32_t positions = addPositions(writer, mesh.positions);
  writer.show({{"attributes", {{"POSITION", positions}}}, {"indices", writer.addArray("SCALAR", mesh.indices)}});
  const TempDirectory directory;
  const auto fails = [&](const char* what, const json& patch) {
    GltfWriter changed = writer;
    changed.root["bufferViews"][0].merge_patch(patch);
    const auto result = readMesh(directory.write("model.glb", changed.glb()));
    ASSERT_FALSE(result) << what;
    EXPECT_NE(result.error().message.find("expected"), std::string::npos) << result.error().message;
    EXPECT_NE(result.error().message.find("bufferViews[0]"), std::string::npos) << result.error().message;
  };
  const auto coding = [](const json& members) { return json{{"extensions", {{"EXT_meshopt_compression", members}}}}; };
  fails("half the bytes", coding({{"byteLength", 4000}}));
  fails("other bytes", coding({{"byteOffset", 8}}));
  fails("another mode", coding({{"mode", "POINTS"}}));
  fails("another filter", coding({{"filter", "LINEAR"}}));
  fails("a filter that does not fit", coding({{"filter", "OCTAHEDRAL"}}));
  fails("a stride that does not fit", coding({{"byteStride", 11}}));
  fails("another stride of the view", {{"byteStride", 16}});
  fails("a count that does not fit", coding({{"count", 7}}));
  json many = coding({{"count", uint64_t{1} << 40}});
  many["byteLength"] = uint64_t{12} << 40;
  fails("a count beyond the bytes", many);
  many = coding({{"count", uint64_t{1} << 62}});
  fails("a count that overflows", many);
  fails("bytes outside the buffer", coding({{"byteOffset", 1 << 30}}));
}

}  // namespace
}  // namespace farcell::test
