#include <cmath>

#include "tests/preprocess/read/gltf/gltf_support.h"

namespace farcell::test {
namespace {

const std::vector<float> kTriangle = {0, 0, 0, 1, 0, 0, 0, 2, 0};
const double kHalf = std::sqrt(0.5);

// A writer with a mesh of one triangle, and nothing that shows it.
GltfWriter oneTriangle(bool withNormals = false) {
  GltfWriter writer;
  json attributes = {{"POSITION", writer.addArray("VEC3", kTriangle)}};
  if (withNormals) attributes["NORMAL"] = writer.addArray<float>("VEC3", {1, 1, 0, 0, 0, 3, 1, 0, 0});
  writer.addMesh({{"attributes", attributes}});
  return writer;
}

void expectTriangle(const InputTriangle& triangle, const Corners& expected) {
  for (size_t i = 0; i < 3; ++i) expectNear(triangle.positions[i], expected[i], 1e-12);
}

TEST(GltfScene, PlacesByTranslationRotationAndScale) {
  GltfWriter writer = oneTriangle();
  // A quarter turn about z, after a scale of 2, 3, 4.
  writer.addNode(
      {{"mesh", 0}, {"translation", {10, 20, 30}}, {"rotation", {0, 0, kHalf, kHalf}}, {"scale", {2, 3, 4}}});
  const ReadMesh mesh = readGlb(writer);
  ASSERT_EQ(mesh.triangles.size(), 1u);
  expectTriangle(mesh.triangles[0], {{{10, 20, 30}, {10, 22, 30}, {4, 20, 30}}});
}

TEST(GltfScene, PlacesByMatrixColumnByColumn) {
  GltfWriter writer = oneTriangle();
  writer.addNode({{"mesh", 0}, {"matrix", {0, 0, 5, 0, 7, 0, 0, 0, 0, 1, 0, 0, 0.5, -0.5, 0.25, 1}}});
  const ReadMesh mesh = readGlb(writer);
  ASSERT_EQ(mesh.triangles.size(), 1u);
  expectTriangle(mesh.triangles[0], {{{0.5, -0.5, 0.25}, {0.5, -0.5, 5.25}, {14.5, -0.5, 0.25}}});
}

TEST(GltfScene, MultipliesFromTheRootDownInDoubles) {
  GltfWriter writer = oneTriangle();
  const uint32_t leaf = writer.add("nodes", {{"mesh", 0}, {"translation", {0.001, 0, 0}}});
  const uint32_t middle = writer.add("nodes", {{"children", {leaf}}, {"scale", {2, 2, 2}}});
  writer.addNode({{"children", {middle}}, {"translation", {5000000.25, 0, 0}}, {"rotation", {0, 0, kHalf, kHalf}}});
  const ReadMesh mesh = readGlb(writer);
  ASSERT_EQ(mesh.triangles.size(), 1u);
  // No float holds 5000000.25; its neighbours are half a unit apart.
  for (size_t i = 0; i < 3; ++i)
    expectNear(mesh.triangles[0].positions[i],
               Corners{{{5000000.25, 0.002, 0}, {5000000.25, 2.002, 0}, {4999996.25, 0.002, 0}}}[i], 2e-9);
}

TEST(GltfScene, TurnsNormalsByTheInverseTranspose) {
  GltfWriter writer = oneTriangle(true);
  writer.addNode({{"mesh", 0}, {"scale", {2, 1, 1}}});
  const ReadMesh mesh = readGlb(writer);
  EXPECT_TRUE(mesh.info.hasNormals);
  ASSERT_EQ(mesh.triangles.size(), 1u);
  // (1, 1, 0) is across the plane of (-1, 1, 0), which becomes (-2, 1, 0).
  expectNear(glm::dvec3(mesh.triangles[0].normals[0]), glm::dvec3(1, 2, 0) / std::sqrt(5.0), 1e-6);
  expectNear(glm::dvec3(mesh.triangles[0].normals[1]), {0, 0, 1}, 1e-6);
}

TEST(GltfScene, LeavesNormalsAsTheyAreWhereNothingTurnsThem) {
  GltfWriter writer = oneTriangle(true);
  writer.addNode({{"mesh", 0}});
  EXPECT_EQ(readGlb(writer).triangles.at(0).normals[1], glm::vec3(0, 0, 3));
}

TEST(GltfScene, MirrorsKeepNormalsAndWindingTogether) {
  GltfWriter writer = oneTriangle(true);
  writer.addNode({{"mesh", 0}, {"scale", {1, -1, 1}}});
  const InputTriangle triangle = readGlb(writer).triangles.at(0);
  // The triangle faced +z, as its second normal says; a mirror across y changes neither.
  const glm::dvec3 facing =
      glm::cross(triangle.positions[1] - triangle.positions[0], triangle.positions[2] - triangle.positions[0]);
  EXPECT_GT(facing.z, 0);
  size_t withOwnNormal = 0;
  for (size_t i = 0; i < 3; ++i)
    if (triangle.positions[i] == glm::dvec3(1, 0, 0)) withOwnNormal += triangle.normals[i] == glm::vec3(0, 0, 1);
  EXPECT_EQ(withOwnNormal, 1u);
}

TEST(GltfScene, HasNormalsOnlyWhenEveryPrimitiveHasThem) {
  GltfWriter writer = oneTriangle(true);
  writer.addNode({{"mesh", 0}});
  EXPECT_TRUE(readGlb(writer).info.hasNormals);
  writer.show({{"attributes", {{"POSITION", 0}}}});
  EXPECT_FALSE(readGlb(writer).info.hasNormals);
  writer.root["meshes"][1]["primitives"][0]["mode"] = 0;  // points need none
  EXPECT_TRUE(readGlb(writer).info.hasNormals);
}

// Four nodes at x = 0, 10, 20, 30 show the triangle; the last is in no scene.
GltfWriter threeScenes() {
  GltfWriter writer = oneTriangle();
  for (int i = 0; i < 4; ++i) writer.add("nodes", {{"mesh", 0}, {"translation", {10 * i, 0, 0}}});
  writer.root["scenes"] = {{{"nodes", {0}}}, {{"nodes", {1, 2}}}, {{"nodes", {2}}}};
  return writer;
}

std::vector<double> placesOf(const GltfWriter& writer) {
  std::vector<double> places;
  for (const InputTriangle& triangle : readGlb(writer).triangles) places.push_back(triangle.positions[0].x);
  return places;
}

TEST(GltfScene, ShowsTheDefaultSceneOrAllOfThemOrAllNodes) {
  GltfWriter writer = threeScenes();
  writer.root["scene"] = 1;
  EXPECT_EQ(placesOf(writer), (std::vector<double>{10, 20}));
  writer.root.erase("scene");
  EXPECT_EQ(placesOf(writer), (std::vector<double>{0, 10, 20}));  // the shared one once
  writer.root.erase("scenes");
  EXPECT_EQ(placesOf(writer), (std::vector<double>{0, 10, 20, 30}));
}

TEST(GltfScene, InstancesOfOneNodeStandWhereTheirAttributesSay) {
  GltfWriter writer = oneTriangle();
  const uint32_t translation = writer.addArray<float>("VEC3", {0, 0, 0, 5, 0, 0, 0, 0, 7});
  const uint32_t rotation =
      writer.addArray<int16_t>("VEC4", {0, 0, 0, 32767, 0, 0, 0, 32767, 0, 0, 32767, 0}, {{"normalized", true}});
  const uint32_t scale = writer.addArray<float>("VEC3", {1, 1, 1, 2, 2, 2, 1, 1, 1});
  writer.addNode({{"mesh", 0},
                  {"translation", {100, 0, 0}},
                  {"extensions",
                   {{"EXT_mesh_gpu_instancing",
                     {{"attributes", {{"TRANSLATION", translation}, {"ROTATION", rotation}, {"SCALE", scale}}}}}}}});
  writer.root["extensionsRequired"] = json::array({"EXT_mesh_gpu_instancing"});
  const ReadMesh mesh = readGlb(writer);
  ASSERT_EQ(mesh.triangles.size(), 3u);
  expectTriangle(mesh.triangles[0], {{{100, 0, 0}, {101, 0, 0}, {100, 2, 0}}});
  expectTriangle(mesh.triangles[1], {{{105, 0, 0}, {107, 0, 0}, {105, 4, 0}}});
  expectTriangle(mesh.triangles[2], {{{100, 0, 7}, {99, 0, 7}, {100, -2, 7}}});  // half a turn about z
}

}  // namespace
}  // namespace farcell::test
