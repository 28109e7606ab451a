#include "preprocess/read/scene/scene_reader.h"

#include "tests/preprocess/read/read_support.h"

namespace farcell::test {
namespace {

// A mesh that says what a test wants; its triangles name each of its textures in turn, and none.
class SaidMesh final : public MeshReader {
 public:
  SaidMesh(MeshInfo info, std::vector<std::string> textures) : info_(std::move(info)) {
    for (const std::string& name : textures) textures_.push_back({.file = name, .embedded = nullptr});
  }

  const MeshInfo& info() const override { return info_; }
  std::span<const TextureSource> textures() const override { return textures_; }
  std::vector<std::filesystem::path> files() const override { return {"said.mesh"}; }
  Result<MeshCounts> forEachTriangle(const Sink& sink) override {
    std::vector<InputTriangle> triangles;
    for (uint32_t i = 0; i <= textures_.size(); ++i) {
      InputTriangle triangle{};
      triangle.positions = {glm::dvec3(0), {1, 0, 0}, {0, 1, 0}};
      triangle.texture = i < textures_.size() ? i : kNoTexture;
      triangle.textureCoordinates = {glm::vec2(0, 0), {1, 0}, {0, 1}};
      triangle.colours = {1, 2, 3};
      triangles.push_back(triangle);
    }
    FARCELL_TRY(sink(triangles));
    return MeshCounts{triangles.size(), {}};
  }

 private:
  MeshInfo info_;
  std::vector<TextureSource> textures_;
};

ScenePart part(const MeshInfo& info, std::vector<std::string> textures, const std::vector<Pose>& poses) {
  ScenePart part{std::make_unique<SaidMesh>(info, std::move(textures)), {}};
  for (const Pose& pose : poses) part.placements.emplace_back(pose);
  return part;
}

std::vector<ScenePart> parts(ScenePart a, ScenePart b) {
  std::vector<ScenePart> both;
  both.push_back(std::move(a));
  both.push_back(std::move(b));
  return both;
}

TEST(SceneReader, ShiftsTexturesAndMirrorsTheirCoordinatesWithTheCorners) {
  const Pose mirror{.scale = {1, 1, -1}};
  const MeshInfo coloured{.hasColours = true, .declaredTriangles = 3, .vertices = 3, .format = ""};
  auto mesh =
      composeMeshes(parts(part(coloured, {"a", "b"}, {Pose{}}), part(coloured, {"c", "d"}, {Pose{}, mirror})), {});
  ASSERT_TRUE(mesh);
  std::vector<std::string> names;
  for (const TextureSource& texture : (*mesh)->textures()) names.push_back(texture.file.string());
  EXPECT_EQ(names, (std::vector<std::string>{"a", "b", "c", "d"}));
  EXPECT_EQ((*mesh)->files().size(), 1u);
  EXPECT_EQ((*mesh)->info().declaredTriangles, 9u);
  MeshCounts counts;
  const auto triangles = collect(**mesh, counts);
  ASSERT_TRUE(triangles);
  std::vector<uint32_t> textures;
  for (const InputTriangle& triangle : *triangles) textures.push_back(triangle.texture);
  EXPECT_EQ(textures, (std::vector<uint32_t>{0, 1, kNoTexture, 2, 3, kNoTexture, 2, 3, kNoTexture}));
  const InputTriangle& mirrored = (*triangles)[6];
  EXPECT_EQ(mirrored.positions[1], glm::dvec3(0, 1, 0));
  EXPECT_EQ(mirrored.textureCoordinates[1], glm::vec2(0, 1));
  EXPECT_EQ(mirrored.colours, (std::array<uint32_t, 3>{1, 3, 2}));
}

TEST(SceneReader, CountsATrillionTrianglesAndRefusesMoreThanItCanCount) {
  const std::vector<Pose> thousand(1024);
  MeshInfo large{.declaredTriangles = uint64_t{1} << 30, .vertices = uint64_t{1} << 29, .format = ""};
  const auto legal = composeMeshes(parts(part(large, {}, thousand), part(large, {}, {Pose{}})), {});
  ASSERT_TRUE(legal);
  EXPECT_EQ((*legal)->info().declaredTriangles, (uint64_t{1} << 40) + (uint64_t{1} << 30));
  EXPECT_EQ((*legal)->info().vertices, (uint64_t{1} << 39) + (uint64_t{1} << 29));

  const MeshInfo one{.declaredTriangles = 1, .vertices = 1, .format = ""};
  large.declaredTriangles = uint64_t{1} << 54;  // 2^64 by the thousand
  const MeshInfo all{.declaredTriangles = ~uint64_t{0}, .vertices = 1, .format = ""};
  const MeshInfo vertices{.declaredTriangles = 1, .vertices = ~uint64_t{0}, .format = ""};
  EXPECT_TRUE(composeMeshes(parts(part(all, {}, {Pose{}}), part({}, {}, {Pose{}})), {}));
  for (auto& tooMany : {std::pair{large, thousand}, {all, std::vector<Pose>(1)}, {vertices, std::vector<Pose>(2)}}) {
    const auto refused = composeMeshes(parts(part(one, {}, {Pose{}}), part(tooMany.first, {}, tooMany.second)), {});
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().kind, ErrorKind::unsupported);
    EXPECT_NE(refused.error().message.find("said.mesh: expected triangles and vertices that 64 bits can count, found"),
              std::string::npos)
        << refused.error().message;
  }
}

TEST(SceneReader, EndsWithTheErrorOfTheSinkWhereverItComes) {
  const std::vector<Pose> poses(5000);
  const MeshInfo info{.declaredTriangles = 1, .vertices = 3, .format = ""};
  auto mesh = composeMeshes(parts(part(info, {}, poses), part(info, {}, {Pose{}})), {});
  ASSERT_TRUE(mesh);
  for (const int last : {1, 2, 3}) {
    int calls = 0;
    const auto result = (*mesh)->forEachTriangle([&](std::span<const InputTriangle>) -> Result<> {
      if (++calls < last) return {};
      return fail(ErrorKind::exhausted, "enough");
    });
    ASSERT_FALSE(result);
    EXPECT_EQ(result.error().message, "enough");
    EXPECT_EQ(calls, last);
  }
}

}  // namespace
}  // namespace farcell::test
