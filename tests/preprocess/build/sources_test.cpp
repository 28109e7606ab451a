// What a pack says about the files it was built from.
#include <gtest/gtest.h>

#include "cache/base/file.h"
#include "cache/base/hash.h"
#include "preprocess/build/build.h"
#include "tests/preprocess/read/read_support.h"

namespace farcell::test {
namespace {

class Sources : public testing::Test {
 protected:
  Sources() {
    a_ = directory_.write("a.off", "OFF 3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n");
    b_ = directory_.write("b.obj", "mtllib b.mtl\nv 0 0 1\nv 1 0 1\nv 0 1 1\nusemtl m\nf 1 2 3\n");
    m_ = directory_.write("b.mtl", "newmtl m\nKd 1 0 0\n");
  }

  Directory build(const std::vector<std::filesystem::path>& meshes, BuildOptions options = {}) const {
    Progress silent(false);
    options.settings.form.views = 12;
    options.settings.form.imageSize = 16;
    const Result<BuildResult> built = buildPack(meshes, directory_.path() / "x.far", options, silent);
    if (built) return built->directory;
    ADD_FAILURE() << built.error().message;
    return {};
  }

  TempDirectory directory_;
  std::filesystem::path a_, b_, m_;
};

std::string bytesOf(const std::filesystem::path& path) { return readTextFile(path, 1 << 20).value(); }

uint64_t hashOf(const std::string& bytes) { return hashBytes(std::as_bytes(std::span(bytes))); }

// As FORMAT.md says: of the files' hashes, eight bytes each.
uint64_t hashOfHashes(const std::vector<std::filesystem::path>& files) {
  std::string hashes;
  for (const std::filesystem::path& file : files)
    for (uint64_t hash = hashOf(bytesOf(file)), i = 0; i < 8; ++i, hash >>= 8) hashes += static_cast<char>(hash & 255);
  return hashOf(hashes);
}

TEST_F(Sources, OneFileIsKnownByTheHashOfItsBytes) {
  const Directory directory = build({a_});
  EXPECT_EQ(directory.sourceName, "a.off");
  EXPECT_EQ(directory.sourceHash, hashOf(bytesOf(a_)));
}

TEST_F(Sources, SeveralFilesAreKnownByTheHashesOfAllThatTheyAreMadeOf) {
  const Directory two = build({a_, b_});
  EXPECT_EQ(two.sourceName, "a.off");
  EXPECT_EQ(two.sourceHash, hashOfHashes({a_, b_, m_}));
  EXPECT_EQ(two.report.inputTriangles, 2u);
  EXPECT_EQ(two.report.inputVertices, 6u);
  EXPECT_TRUE(two.model.hasColours);
  const Directory turned = build({b_, a_});
  EXPECT_EQ(turned.sourceName, "b.obj");
  EXPECT_EQ(turned.sourceHash, hashOfHashes({b_, m_, a_}));
  EXPECT_EQ(build({b_}).sourceHash, hashOfHashes({b_, m_})) << "materials are of the source";
  const auto scene =
      directory_.write("s.json", R"({"files":[{"path":"b.obj"},{"path":"b.obj","scale":2},{"path":"a.off"}]})");
  const Directory placed = build({scene});
  EXPECT_EQ(placed.sourceName, "s.json");
  EXPECT_EQ(placed.sourceHash, hashOfHashes({scene, b_, m_, a_}));
}

TEST_F(Sources, UpAndUnitAreTheModelsWhereTheBuildIsToldSo) {
  const auto scene = directory_.write("s.json", R"({"up":"x","unit":"in","files":[{"path":"a.off"}]})");
  BuildOptions options;
  EXPECT_EQ(build({scene}, options).model.settings.up, UpAxis::z);
  EXPECT_EQ(build({scene}, options).model.settings.metresPerUnit, 1);
  options.upOfModel = options.unitOfModel = true;
  EXPECT_EQ(build({scene}, options).model.settings.up, UpAxis::x);
  EXPECT_EQ(build({scene}, options).model.settings.metresPerUnit, 0.0254);
  EXPECT_EQ(build({b_}, options).model.settings.up, UpAxis::y);
  EXPECT_EQ(build({a_, b_}, options).model.settings.up, UpAxis::z);
}

}  // namespace
}  // namespace farcell::test
