// Scene files and several files, as openMesh and openMeshes read them.
#include <glm/geometric.hpp>

#include "cache/schema/model.h"
#include "tests/preprocess/read/read_support.h"

namespace farcell::test {
namespace {

constexpr uint32_t kAlbedo = kDefaultAlbedo[0] | kDefaultAlbedo[1] << 8 | kDefaultAlbedo[2] << 16;
constexpr const char* kTriangleObj = "v 1 0 0\nv 0 2 0\nv 0 0 3\nf 1 2 3\nf 1 1 2\nf 1 2 9\n";
const std::array<glm::dvec3, 3> kTriangle = {glm::dvec3(1, 0, 0), {0, 2, 0}, {0, 0, 3}};

class Scenes : public testing::Test {
 protected:
  Scenes() { directory_.write("t.obj", kTriangleObj); }

  // A scene of one file, t.obj, with these other members.
  ReadMesh placed(const std::string& members) const {
    return readGood(directory_.write("scene.json", R"({"files":[{"path":"t.obj",)" + members + "}]}"));
  }
  std::array<glm::dvec3, 3> first(const std::string& members) const {
    const ReadMesh mesh = placed(members);
    return mesh.triangles.empty() ? std::array<glm::dvec3, 3>{} : mesh.triangles[0].positions;
  }

  TempDirectory directory_;
};

TEST_F(Scenes, AFileStandsAsItIsUnlessToldOtherwise) {
  EXPECT_EQ(readGood(directory_.write("scene.json", R"({"files":[{"path":"t.obj"}]})")).triangles[0].positions,
            kTriangle);
  EXPECT_EQ(first(R"("translation":[0,0,0],"rotation":[0,0,0,1],"scale":1)"), kTriangle);
  EXPECT_EQ(first(R"("rotation":{"axis":[3,4,5],"angleDeg":-720},"scale":[1,1,1])"), kTriangle);
}

TEST_F(Scenes, IsScaledThenTurnedThenMoved) {
  const std::array<glm::dvec3, 3> expected = {glm::dvec3(10, 22, 30), {4, 20, 30}, {10, 20, 42}};
  // By 2, 3 and 4; a quarter turn about z takes x to y and y to -x.
  const std::string moved = R"("translation":[10,20,30],"scale":[2,3,4],)";
  EXPECT_EQ(first(moved + R"("rotation":{"axis":[0,0,2],"angleDeg":90})"), expected);
  EXPECT_EQ(first(moved + R"("rotation":{"axis":[0,0,-1],"angleDeg":270})"), expected);
  EXPECT_EQ(first(moved + R"("rotation":[0,0,0.7071067811865476,0.7071067811865476])"), expected);
  EXPECT_EQ(first(moved + R"("rotation":[0,0,-5e200,-5e200])"), expected) << "of any length and sign";
}

TEST_F(Scenes, QuarterTurnsAboutTheAxesAreExact) {
  const auto turned = [&](const char* axis, int angleDeg) {
    return first(fmt::format(R"("rotation":{{"axis":{},"angleDeg":{}}})", axis, angleDeg))[0];
  };
  EXPECT_EQ(turned("[0,0,1]", 90), glm::dvec3(0, 1, 0));
  EXPECT_EQ(turned("[0,0,1]", 180), glm::dvec3(-1, 0, 0));
  EXPECT_EQ(turned("[0,0,1]", -90), glm::dvec3(0, -1, 0));
  EXPECT_EQ(turned("[0,0,1]", 450), glm::dvec3(0, 1, 0));
  EXPECT_EQ(turned("[0,1,0]", 90), glm::dvec3(0, 0, -1));
  EXPECT_EQ(turned("[1,0,0]", 90), glm::dvec3(1, 0, 0));
}

TEST_F(Scenes, OtherTurnsKeepLengthsAndGoTheRightWay) {
  const auto corners = first(R"("rotation":{"axis":[1,1,1],"angleDeg":120})");  // x to y to z to x
  for (const auto& [corner, expected] :
       {std::pair{corners[0], glm::dvec3(0, 1, 0)}, {corners[1], {0, 0, 2}}, {corners[2], {3, 0, 0}}})
    EXPECT_LT(glm::length(corner - expected), 1e-14);
  const auto quaternion = first(R"("rotation":[0.1,-0.2,0.3,0.4])");
  const double angleDeg = 2 * std::atan2(std::sqrt(0.14), 0.4) * 180 / 3.14159265358979323846;
  const auto axis = first(fmt::format(R"("rotation":{{"axis":[0.1,-0.2,0.3],"angleDeg":{}}})", angleDeg));
  for (size_t i = 0; i < 3; ++i) EXPECT_LT(glm::length(quaternion[i] - axis[i]), 1e-14);
}

TEST_F(Scenes, InstancesAreAppliedAfterTheFilesOwnTransform) {
  const ReadMesh mesh = placed(
      R"("translation":[1,0,0],"scale":2,"instances":[{},{"translation":[0,0,100]},
         {"rotation":{"axis":[0,0,1],"angleDeg":90},"scale":10,"translation":[7,0,0]}])");
  EXPECT_EQ(mesh.info.vertices, 9u);
  EXPECT_EQ(mesh.info.declaredTriangles, 9u);
  EXPECT_EQ(mesh.counts.skipped, (std::map<std::string, uint64_t>{{kSkippedBadIndex, 3}, {kSkippedZeroArea, 3}}));
  ASSERT_EQ(mesh.triangles.size(), 3u);
  EXPECT_EQ(mesh.triangles[0].positions[0], glm::dvec3(3, 0, 0));
  EXPECT_EQ(mesh.triangles[1].positions[0], glm::dvec3(3, 0, 100));
  EXPECT_EQ(mesh.triangles[2].positions[0], glm::dvec3(7, 30, 0));
}

TEST_F(Scenes, MovesInDoubles) {
  const auto corners = first(R"("translation":[450123.0625,5412345.000000001,-0.1])");
  EXPECT_EQ(corners[0], glm::dvec3(450124.0625, 5412345.000000001, -0.1));
}

TEST_F(Scenes, AMirrorKeepsTheOutsideOutside) {
  const auto outward = [](const std::array<glm::dvec3, 3>& t) { return glm::cross(t[1] - t[0], t[2] - t[0]); };
  const glm::dvec3 before = outward(kTriangle);
  for (const auto& [scale, sign] :
       {std::pair{"[-1,1,1]", glm::dvec3(-1, 1, 1)}, {"[-1,-1,1]", {-1, -1, 1}}, {"-1", glm::dvec3(-1)}}) {
    const auto corners = first(fmt::format(R"("scale":{})", scale));
    EXPECT_EQ(corners[0], kTriangle[0] * sign);
    EXPECT_EQ(outward(corners), before * sign) << scale;
  }
  EXPECT_EQ(first(R"("scale":[1,1,-1],"instances":[{"scale":[-1,1,1]}])")[1], kTriangle[1]) << "two mirrors are none";
}

TEST_F(Scenes, NormalsStayPerpendicular) {
  // The normal of the plane x + y / 2 + z / 3 = 1.
  directory_.write("n.obj", "v 1 0 0\nv 0 2 0\nv 0 0 3\nvn 6 3 2\nvn 0 0 0\nf 1//1 2//1 3//1\nf 1//1 3//1 2//2\n");
  const auto read = [&](const std::string& pose) {
    return readGood(directory_.write("scene.json", R"({"files":[{"path":"n.obj",)" + pose + "}]}"));
  };
  for (const char* pose :
       {R"("scale":[1,10,0.1])", R"("scale":[-2,3,4],"rotation":[0.1,0.2,-0.3,0.9])",
        R"("scale":1e-12,"instances":[{"scale":[1e-12,1e-12,3e-12]}])",
        R"("scale":[1,1,2],"instances":[{"rotation":{"axis":[1,2,3],"angleDeg":40},"scale":[5,1,1]}])"}) {
    const ReadMesh mesh = read(pose);
    EXPECT_TRUE(mesh.info.hasNormals);
    ASSERT_EQ(mesh.triangles.size(), 2u);
    const auto& [a, b, c] = mesh.triangles[0].positions;
    const glm::dvec3 normal(mesh.triangles[0].normals[0]);
    EXPECT_NEAR(glm::length(normal), 1, 1e-6) << pose;
    EXPECT_NEAR(glm::dot(normal, glm::normalize(b - a)), 0, 1e-6) << pose;
    EXPECT_NEAR(glm::dot(normal, glm::normalize(c - a)), 0, 1e-6) << pose;
    EXPECT_GT(glm::dot(normal, glm::normalize(glm::cross(glm::normalize(b - a), glm::normalize(c - a)))), 0) << pose;
  }
  const ReadMesh zero = read(R"("scale":2)");
  EXPECT_EQ(zero.triangles[1].normals[2], glm::vec3(0)) << "no direction stays none";
}

TEST_F(Scenes, FilesWithoutColoursOrNormalsTakeTheDefaultAndTheFace) {
  directory_.write("c.off", "CNOFF\n3 1 0\n0 0 0 0 0 2 9 8 7\n1 0 0 0 0 2 9 8 7\n0 1 0 0 0 2 9 8 7\n3 0 1 2\n");
  const ReadMesh mesh = readGood(
      directory_.write("scene.json", R"({"files":[{"path":"t.obj"},{"path":"c.off"},{"path":"t.obj","scale":2}]})"));
  EXPECT_TRUE(mesh.info.hasColours);
  EXPECT_TRUE(mesh.info.hasNormals);
  ASSERT_EQ(mesh.triangles.size(), 3u);
  EXPECT_EQ(mesh.triangles[1].colours[2], 0x070809u);
  EXPECT_EQ(mesh.triangles[1].normals[2], glm::vec3(0, 0, 1));
  for (const size_t plain : {size_t{0}, size_t{2}}) {
    EXPECT_EQ(mesh.triangles[plain].colours, (std::array<uint32_t, 3>{kAlbedo, kAlbedo, kAlbedo}));
    for (const glm::vec3& normal : mesh.triangles[plain].normals)
      EXPECT_LT(glm::length(normal - glm::vec3(6, 3, 2) / 7.0f), 1e-6f);
  }
}

TEST_F(Scenes, TrianglesThatATransformSpoilsAreCounted) {
  // Too small for doubles at that distance; too large for doubles.
  const ReadMesh flat = placed(R"("scale":1e-12,"translation":[1e9,1e9,1e9],"instances":[{},{}])");
  EXPECT_EQ(flat.counts.accepted, 0u);
  EXPECT_EQ(flat.counts.skipped, (std::map<std::string, uint64_t>{{kSkippedBadIndex, 2}, {kSkippedZeroArea, 4}}));
  directory_.write("t.obj", "v 1e300 0 0\nv 0 1e300 0\nv 0 0 1e300\nf 1 2 3\n");
  const ReadMesh infinite = placed(R"("scale":1e12)");
  EXPECT_EQ(infinite.counts.skipped, (std::map<std::string, uint64_t>{{kSkippedNonFinite, 1}}));
}

TEST_F(Scenes, NamesEveryFileOnceTheSceneFirst) {
  directory_.write("m.mtl", "newmtl a\nKd 1 0 0\n");
  std::filesystem::create_directories(directory_.path() / "sub");
  directory_.write("sub/u.obj", kTriangleObj);
  directory_.write("t.obj", std::string("mtllib m.mtl\n") + kTriangleObj);
  const std::filesystem::path absolute = directory_.path() / "sub" / "u.obj";
  const auto scene = directory_.write(
      "scene.json", fmt::format(R"({{"files":[{{"path":"sub/u.obj"}},{{"path":"t.obj"}},{{"path":"sub/../t.obj"}},
                                           {{"path":"{}"}}]}})",
                                absolute.string()));
  const auto mesh = openMesh(scene);
  ASSERT_TRUE(mesh) << mesh.error().message;
  EXPECT_EQ((*mesh)->files(), (std::vector<std::filesystem::path>{scene, absolute, directory_.path() / "t.obj",
                                                                  directory_.path() / "m.mtl"}));
  EXPECT_EQ((*mesh)->info().format, "scene");
  EXPECT_EQ((*mesh)->info().declaredTriangles, 12u);
}

TEST_F(Scenes, SayTheirUpAndUnitOrTakeThoseOfTheFirstFile) {
  directory_.write("p.off", "OFF 0 0 0");
  const auto info = [&](const std::string& members) {
    const auto mesh = openMesh(directory_.write("scene.json", "{" + members + "}"));
    return mesh ? (*mesh)->info() : (ADD_FAILURE() << mesh.error().message, MeshInfo{});
  };
  EXPECT_EQ(info(R"("files":[{"path":"t.obj"},{"path":"p.off"}])").up, UpAxis::y);
  EXPECT_EQ(info(R"("files":[{"path":"p.off"},{"path":"t.obj"}])").up, UpAxis::z);
  EXPECT_EQ(info(R"("files":[{"path":"t.obj"}],"up":"x")").up, UpAxis::x);
  EXPECT_EQ(info(R"("files":[{"path":"t.obj"}])").metresPerUnit, 1);
  EXPECT_EQ(info(R"("unit":"ft","files":[{"path":"t.obj"}])").metresPerUnit, 0.3048);
  EXPECT_EQ(info(R"("unit":2.5,"files":[{"path":"t.obj"}])").metresPerUnit, 2.5);
}

TEST_F(Scenes, SeveralFilesAreOneModelInTheirOrder) {
  const auto off = directory_.write("p.off", "OFF 3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n");
  const std::vector<std::filesystem::path> paths = {off, directory_.path() / "t.obj"};
  const auto mesh = openMeshes(paths);
  ASSERT_TRUE(mesh);
  EXPECT_EQ((*mesh)->files(), paths);
  EXPECT_EQ((*mesh)->info().up, UpAxis::z);
  EXPECT_EQ((*mesh)->info().declaredTriangles, 4u);
  EXPECT_FALSE((*mesh)->info().hasNormals);
  MeshCounts counts;
  const auto triangles = collect(**mesh, counts);
  ASSERT_TRUE(triangles);
  ASSERT_EQ(triangles->size(), 2u);
  EXPECT_EQ((*triangles)[1].positions, kTriangle);
  EXPECT_EQ(openMeshes({&off, 1}).value()->info().format, "OFF") << "one file is itself";
}

TEST_F(Scenes, SeveralFilesFailWithTheFirstThatIsWrong) {
  const std::vector<std::filesystem::path> paths = {directory_.path() / "t.obj", directory_.write("bad.off", "OFX")};
  const auto mesh = openMeshes(paths);
  ASSERT_FALSE(mesh);
  EXPECT_TRUE(mesh.error().message.starts_with(paths[1].string())) << mesh.error().message;
  for (const size_t count : {size_t{0}, size_t{1001}}) {
    const auto refused = openMeshes(std::vector<std::filesystem::path>(count, paths[0]));
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().kind, ErrorKind::invalidArgument);
  }
}

}  // namespace
}  // namespace farcell::test
