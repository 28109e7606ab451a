#include "preprocess/read/obj/obj_map.h"
#include "tests/preprocess/read/read_support.h"

namespace farcell {
namespace {

using namespace test;

constexpr const char* kSquare =
    "mtllib square.mtl\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0 0\nvt 1 0 0\nvt 1 1\nvt .25 .75\n"
    "usemtl wall\nf 1/1 2/2 3/3 4/4\n";

ObjMap mapOf(const std::string& statement) { return parseObjMap(statement).value_or(ObjMap{}); }

TEST(ObjMaps, OptionsAreTakenOrPassedOver) {
  EXPECT_EQ(mapOf("wall.png").name, "wall.png");
  EXPECT_EQ(mapOf(" \t old brick wall.png \r").name, "old brick wall.png");
  EXPECT_EQ(mapOf("tex\\sub\\wall.png").name, "tex/sub/wall.png");
  EXPECT_EQ(mapOf("tex/../wall.png").name, "wall.png");
  const ObjMap map = mapOf("-s 2 3 1 -o .5 -clamp on -mm 0 1 -bm 0.2 -blendu off -imfchan r -texres 512 a b.jpg");
  EXPECT_EQ(map.name, "a b.jpg");
  EXPECT_TRUE(map.clamped);
  EXPECT_EQ(map.scale, glm::vec2(2, 3));
  EXPECT_EQ(map.offset, glm::vec2(.5f, 0));
  EXPECT_FALSE(mapOf("-clamp off x.png").clamped);
  EXPECT_EQ(mapOf("-o 1 2 3 7.png").name, "7.png");
  EXPECT_EQ(mapOf("-new.png").name, "-new.png");
}

TEST(ObjMaps, ANameThatLeadsElsewhereIsLookedForByItsLastPart) {
  for (const char* name : {"../../etc/wall.png", "/home/me/wall.png", "C:\\models\\wall.png", "a/../../wall.png"})
    EXPECT_EQ(mapOf(name).name, "wall.png") << name;
  for (const char* none : {"", "   ", "..", "-clamp on", "/", "C:\\", "-s 1 2 3"})
    EXPECT_FALSE(parseObjMap(none)) << none;
}

TEST(ObjTextures, CornersCarryCoordinatesAndTheTexture) {
  const TempDirectory directory;
  directory.write("wall.png", "not looked at");
  directory.write("square.mtl", "newmtl wall\nmap_Kd -s 2 -o 1 0 wall.png\n");
  const auto reader = openMesh(directory.write("square.obj", kSquare)).value();
  ASSERT_EQ(reader->textures().size(), 1u);
  EXPECT_EQ(reader->textures()[0].file, directory.path() / "wall.png");
  EXPECT_EQ(reader->textures()[0].wrapU, TextureWrap::repeat);
  EXPECT_TRUE(reader->info().hasColours);
  MeshCounts counts;
  const std::vector<InputTriangle> triangles = collect(*reader, counts).value();
  ASSERT_EQ(triangles.size(), 2u);
  EXPECT_EQ(triangles[1].texture, 0u);
  EXPECT_EQ(triangles[1].textureCoordinates, (std::array{glm::vec2(1, 0), glm::vec2(3, 1), glm::vec2(1.5f, .75f)}));
  EXPECT_EQ(triangles[1].colours[0], 0xffffffu) << "without Kd it is white";
}

TEST(ObjTextures, KdMultipliesTheTexture) {
  const TempDirectory directory;
  directory.write("square.mtl", "newmtl wall\nKd 1 0.2 0\nmap_Kd wall.png\n");
  const ReadMesh mesh = readGood(directory.write("square.obj", kSquare));
  EXPECT_EQ(mesh.triangles[0].colours[2], 0x0033ffu);
  EXPECT_EQ(mesh.triangles[0].texture, 0u);
}

TEST(ObjTextures, OpacityMakesMaterialsBlendFromBothSides) {
  const TempDirectory directory;
  directory.write("wall.png", "not looked at");
  directory.write("holes.png", "neither");
  struct Case {
    std::string material;
    AlphaMode alpha;
    float opacity;
    bool hasImage;
    std::string opacityFile;
  };
  const std::vector<Case> cases = {{"map_Kd wall.png", AlphaMode::opaque, 1, true, ""},
                                   {"map_Kd wall.png\nd 0.25", AlphaMode::blend, 0.25f, true, ""},
                                   {"map_Kd wall.png\nTr 0.25", AlphaMode::blend, 0.75f, true, ""},
                                   {"map_Kd wall.png\nd nan\nTr x", AlphaMode::opaque, 1, true, ""},
                                   {"map_Kd wall.png\nd -3", AlphaMode::blend, 0, true, ""},
                                   {"map_Kd wall.png\nmap_d wall.png", AlphaMode::blend, 1, true, ""},
                                   {"map_Kd wall.png\nmap_d holes.png", AlphaMode::blend, 1, true, "holes.png"},
                                   {"map_d holes.png", AlphaMode::blend, 1, true, "holes.png"},
                                   {"map_Kd wall.png\nmap_d missing.png", AlphaMode::opaque, 1, true, ""},
                                   {"Kd 1 0 0\nd -halo 0.5", AlphaMode::blend, 0.5f, false, ""}};
  for (const Case& expected : cases) {
    directory.write("square.mtl", "newmtl wall\n" + expected.material + "\n");
    const auto reader = openMesh(directory.write("square.obj", kSquare)).value();
    MeshCounts counts;
    const uint32_t index = collect(*reader, counts).value().at(0).texture;
    ASSERT_LT(index, reader->textures().size()) << expected.material;
    const TextureSource& found = reader->textures()[index];
    EXPECT_EQ(found.surface, (SurfaceKind{.hasImage = expected.hasImage, .alpha = expected.alpha}))
        << expected.material;
    EXPECT_EQ(found.opacity, expected.opacity) << expected.material;
    EXPECT_EQ(found.opacityFile.filename(), expected.opacityFile) << expected.material;
  }
}

TEST(ObjTextures, AFaceWithoutUsableCoordinatesHasNoTexture) {
  const TempDirectory directory;
  directory.write("square.mtl", "newmtl wall\nKd 1 0 0\nmap_Kd wall.png\nnewmtl plain\nKd 0 1 0\n");
  const std::string faces =
      "f 1 2 3\nf 1/1 2/2 3\nf 1/1 2/2 3/9\nf 1/1 2/2 3/0\nf -4/-4 -3/-3 -2/-1\nusemtl plain\nf 1/1 2/2 3/3\n";
  const ReadMesh mesh = readGood(directory.write("square.obj", kSquare + faces));
  ASSERT_EQ(mesh.triangles.size(), 8u);
  for (size_t i = 2; i < 6; ++i) {
    EXPECT_EQ(mesh.triangles[i].texture, kNoTexture) << i;
    EXPECT_EQ(mesh.triangles[i].colours[0], 0x0000ffu) << i;
  }
  EXPECT_EQ(mesh.triangles[6].texture, 0u);
  EXPECT_EQ(mesh.triangles[6].textureCoordinates[2], glm::vec2(.25f, .75f));
  EXPECT_EQ(mesh.triangles[7].texture, kNoTexture);
}

TEST(ObjTextures, MaterialsShareAnImageAndUnusedOnesBringNone) {
  const TempDirectory directory;
  std::filesystem::create_directory(directory.path() / "mats");
  directory.write("mats/wall.png", "beside the library");
  directory.write("wall.png", "beside the mesh");
  directory.write("roof.png", "beside the mesh");
  directory.write("mats/all.mtl",
                  "newmtl a\nmap_Kd wall.png\nnewmtl b\nmap_Kd wall.png\nnewmtl c\nmap_Kd -clamp on wall.png\n"
                  "newmtl d\nmap_Kd roof.png\nnewmtl e\nmap_Kd unused.png\nnewmtl f\nmap_Kd missing.png\n");
  const auto mesh = directory.write("m.obj",
                                    "mtllib mats/all.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nusemtl a\nf 1/1 2/1 3/1\n"
                                    "usemtl b\nf 1/1 2/1 3/1\nusemtl c\nf 1/1 2/1 3/1\nusemtl d\nf 1/1 2/1 3/1\n"
                                    "usemtl f\nf 1/1 2/1 3/1\n");
  const auto reader = openMesh(mesh).value();
  ASSERT_EQ(reader->textures().size(), 4u);
  EXPECT_EQ(reader->textures()[0].file, directory.path() / "mats/wall.png");
  EXPECT_EQ(reader->textures()[1].wrapV, TextureWrap::clamp);
  EXPECT_EQ(reader->textures()[2].file, directory.path() / "roof.png");
  const std::vector<std::filesystem::path> expected = {
      mesh, directory.path() / "mats/all.mtl", directory.path() / "mats/wall.png", directory.path() / "roof.png"};
  EXPECT_EQ(reader->files(), expected) << "those that exist, each once";
}

TEST(ObjTextures, BadCoordinatesAreAnErrorOfTheirLine) {
  const TempDirectory directory;
  for (const char* line : {"vt", "vt x", "vt 1 y"}) {
    const auto result = readMesh(directory.write("bad.obj", std::string("v 0 0 0\n") + line + "\n"));
    ASSERT_FALSE(result) << line;
    EXPECT_NE(result.error().message.find("line 2"), std::string::npos) << result.error().message;
  }
}

}  // namespace
}  // namespace farcell
