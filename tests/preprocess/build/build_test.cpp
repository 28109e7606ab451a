#include "preprocess/build/build.h"

#include <gtest/gtest.h>
#include <hwy/targets.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <glm/geometric.hpp>
#include <map>
#include <numbers>

#include "cache/base/file.h"
#include "cache/pack/pack_file.h"
#include "cache/schema/view_frame.h"
#include "preprocess/build/bake_job.h"
#include "preprocess/read/open_mesh.h"

namespace farcell {
namespace {

// A closed sphere of 2 * rings * 2 * rings triangles as an OBJ file.
std::string sphereObj(int rings, double radius, glm::dvec3 centre) {
  std::string text;
  const int columns = 2 * rings;
  for (int i = 0; i <= rings; ++i) {
    for (int j = 0; j < columns; ++j) {
      const double polar = std::numbers::pi * i / rings, azimuth = 2 * std::numbers::pi * j / columns;
      const glm::dvec3 p = centre + radius * glm::dvec3(std::sin(polar) * std::cos(azimuth),
                                                        std::sin(polar) * std::sin(azimuth), std::cos(polar));
      text += fmt::format("v {:.12g} {:.12g} {:.12g}\n", p.x, p.y, p.z);
    }
  }
  for (int i = 0; i < rings; ++i) {
    for (int j = 0; j < columns; ++j) {
      const int a = i * columns + j + 1, b = i * columns + (j + 1) % columns + 1;
      text += fmt::format("f {} {} {}\nf {} {} {}\n", a, a + columns, b, b, a + columns, b + columns);
    }
  }
  return text;
}

class BuildPack : public testing::Test {
 protected:
  void SetUp() override {
    directory_ = std::filesystem::path(testing::TempDir()) / fmt::format("farcell-build-{}", ::getpid());
    std::filesystem::create_directories(directory_);
  }
  void TearDown() override { std::filesystem::remove_all(directory_); }

  std::filesystem::path write(const std::string& name, const std::string& text) const {
    std::ofstream(directory_ / name) << text;
    return directory_ / name;
  }
  Result<BuildResult> build(const std::filesystem::path& mesh, const std::string& pack,
                            BuildOptions options = {}) const {
    Progress silent(false);
    return buildPack({&mesh, 1}, directory_ / pack, options, silent);
  }
  std::string bytesOf(const std::string& name) const {
    return readTextFile(directory_ / name, uint64_t{1} << 30).value();
  }

  std::filesystem::path directory_;
};

BuildOptions smallLeaves() {
  BuildOptions options;
  options.settings.leafTriangles = 600;
  options.settings.form.imageSize = 64;
  options.settings.samples = 4;
  options.settings.measure = Measure::off;  // measured_build_test.cpp
  return options;
}

TEST_F(BuildPack, ThePackOpensAndVerifiesAndCountsWhatWentIn) {
  const auto mesh = write("sphere.obj", sphereObj(40, 3, glm::dvec3(0)));
  const Result<BuildResult> built = build(mesh, "sphere.far", smallLeaves());
  ASSERT_TRUE(built) << built.error().message;
  const Result<PackFile> pack = PackFile::open(directory_ / "sphere.far");
  ASSERT_TRUE(pack) << pack.error().message;
  EXPECT_EQ(pack->sizeBytes(), built->packBytes);
  EXPECT_TRUE(pack->verify(10, [](uint64_t) {}).empty());
  const BuildReport& report = pack->directory().report;
  // At the north pole, whose corners are all one point, half the triangles of the first ring have no area. (The south
  // pole's differ in their last digit: sin(pi) is not zero.)
  EXPECT_EQ(report.inputTriangles, 40u * 160 - 80);
  EXPECT_EQ(report.skipped.at(kSkippedZeroArea), 80u);
  uint64_t leftOut = 0;
  for (const auto& [reason, views] : report.viewsLeftOut) leftOut += views;
  EXPECT_EQ(report.viewsKept + leftOut, 42 * pack->directory().cells.size());
  EXPECT_GT(pack->directory().cells.size(), 9u);
}

TEST_F(BuildPack, AnyNumberOfThreadsGivesTheSameBytes) {
  const auto mesh = write("sphere.obj", sphereObj(40, 3, glm::dvec3(1e6, -2e6, 5)));
  BuildOptions options = smallLeaves();
  options.threads = 1;
  ASSERT_TRUE(build(mesh, "one.far", options));
  for (const int threads : {2, 8}) {
    options.threads = threads;
    ASSERT_TRUE(build(mesh, "many.far", options));
    EXPECT_TRUE(bytesOf("many.far") == bytesOf("one.far")) << threads;
  }
}

// How far apart two views are in any channel; 256 where they do not see the same.
int distance(const ViewImage& a, const ViewImage& b) {
  if (a.view != b.view || a.rgba.size() != b.rgba.size() || a.normal.size() != b.normal.size()) return 256;
  int worst = 0;
  for (size_t i = 0; i < a.rgba.size(); ++i) worst = std::max(worst, std::abs(a.rgba[i] - b.rgba[i]));
  for (size_t i = 0; i < a.normal.size(); ++i) worst = std::max(worst, std::abs(a.normal[i] - b.normal[i]));
  for (size_t i = 0; i < a.depth.size(); ++i) {
    if ((a.depth[i] == 0) != (b.depth[i] == 0) || (a.rgba[4 * i + 3] == 255) != (b.rgba[4 * i + 3] == 255)) return 256;
    worst = std::max(worst, std::abs(a.depth[i] - b.depth[i]));
  }
  return worst;
}

TEST_F(BuildPack, ViewsAreNoFartherFromWhatWasBakedThanTheirError) {
  const auto mesh = write("sphere.obj", sphereObj(20, 3, glm::dvec3(1e6, -2e6, 5)));
  BuildOptions options = smallLeaves();
  options.settings.lighting = Lighting::relightable;
  ASSERT_TRUE(build(mesh, "exact.far", options));
  options.settings.viewError = 3;
  ASSERT_TRUE(build(mesh, "near.far", options));
  const auto exact = PackFile::open(directory_ / "exact.far"), near = PackFile::open(directory_ / "near.far");
  ASSERT_TRUE(exact && near);
  EXPECT_EQ(near->directory().model.settings.viewError, 3);
  EXPECT_LT(near->directory().report.impostorBytes, exact->directory().report.impostorBytes * 7 / 10);
  // Views that bring less than they cost may be left out of one pack and not of the other.
  const auto viewsOf = [](const PackFile& pack) {
    std::map<std::pair<uint32_t, uint32_t>, ViewImage> views;
    for (uint32_t page = 0; page < pack.directory().pages.size(); ++page) {
      if (pack.directory().pages[page].kind != PageKind::views) continue;
      const ViewPage decoded = pack.readViews(page).value();
      for (const ViewImage& view : decoded.views) views[{pack.directory().pages[page].cell, view.view}] = view;
    }
    return views;
  };
  const auto baked = viewsOf(*exact);
  int compared = 0, worst = 0;
  for (const auto& [key, view] : viewsOf(*near)) {
    const auto other = baked.find(key);
    if (other == baked.end()) continue;
    worst = std::max(worst, distance(view, other->second));
    ++compared;
  }
  EXPECT_EQ(worst, 3);
  EXPECT_GT(compared, 300);
}

// A colour that holds a sun's light would be wrong under another.
TEST_F(BuildPack, OnlyMeshesOfBakedPacksShowLitColours) {
  const auto mesh = write("sphere.obj", sphereObj(30, 3, glm::dvec3(1e6, -2e6, 5)));
  const auto pagesWithShown = [&](Lighting lighting) {
    BuildOptions options = smallLeaves();
    options.settings.lighting = lighting;
    EXPECT_TRUE(build(mesh, "lit.far", options));
    const auto pack = PackFile::open(directory_ / "lit.far");
    int count = 0;
    for (uint32_t page = 0; page < pack->directory().pages.size(); ++page)
      if (pack->directory().pages[page].kind == PageKind::geometry) count += !pack->readGeometry(page)->shown.empty();
    return count;
  };
  EXPECT_GT(pagesWithShown(Lighting::baked), 0);
  EXPECT_EQ(pagesWithShown(Lighting::relightable), 0);
}

TEST_F(BuildPack, EveryInstructionSetAndMemoryGivesTheSameBytes) {
  const auto mesh = write("sphere.obj", sphereObj(30, 3, glm::dvec3(1e6, -2e6, 5)));
  BuildOptions options = smallLeaves();
  options.settings.viewError = 1;
  options.threads = 2;
  ASSERT_TRUE(build(mesh, "best.far", options));
  for (const int64_t target : hwy::SupportedAndGeneratedTargets()) {
    hwy::SetSupportedTargetsForTest(target);
    EXPECT_TRUE(build(mesh, "target.far", options));
    hwy::SetSupportedTargetsForTest(0);
    EXPECT_TRUE(bytesOf("target.far") == bytesOf("best.far")) << hwy::TargetName(target);
  }
  options.memoryBytes = kMinMemoryBytes;
  ASSERT_TRUE(build(mesh, "little.far", options));
  EXPECT_TRUE(bytesOf("little.far") == bytesOf("best.far"));
}

TEST_F(BuildPack, LeafTrianglesTileTheSphere) {
  const auto mesh = write("sphere.obj", sphereObj(60, 1, glm::dvec3(0)));
  BuildOptions options = smallLeaves();
  options.settings.form.imageSize = 16;
  options.settings.samples = 1;
  ASSERT_TRUE(build(mesh, "sphere.far", options));
  const PackFile pack = PackFile::open(directory_ / "sphere.far").value();
  const Directory& directory = pack.directory();
  double area = 0;
  for (const CellRecord& cell : directory.cells) {
    if (cell.childCount > 0) continue;
    const GeometryPage page = pack.readGeometry(cell.firstGeometryPage).value();
    EXPECT_EQ(page.indices.size(), 3 * cell.triangles);
    for (size_t i = 0; i < page.indices.size(); i += 3) {
      const auto corner = [&](size_t k) { return glm::dvec3(page.positions[page.indices[i + k]]); };
      area += 0.5 * glm::length(glm::cross(corner(1) - corner(0), corner(2) - corner(0)));
    }
  }
  area *= directory.model.grid.step() * directory.model.grid.step();
  EXPECT_NEAR(area, 4 * std::numbers::pi, 0.03);
}

// Every view of the root sees a disc: area and prefiltered edge come out of coverage.
TEST_F(BuildPack, RootViewsOfASphereCoverADiscFromEveryDirection) {
  const auto mesh = write("sphere.obj", sphereObj(60, 1, glm::dvec3(0)));
  BuildOptions options = smallLeaves();
  options.settings.samples = 16;
  ASSERT_TRUE(build(mesh, "sphere.far", options));
  const PackFile pack = PackFile::open(directory_ / "sphere.far").value();
  const Directory& directory = pack.directory();
  const CellRecord& root = directory.cells[0];
  const double texel = texelSize(64) * cellHalfSide(directory.model.grid, root.key);
  int views = 0;
  for (uint32_t i = 0; i < root.viewPageCount; ++i) {
    const ViewPage page = pack.readViews(root.firstViewPage + i).value();
    for (const ViewImage& image : page.views) {
      ++views;
      double coverage = 0;
      for (size_t t = 3; t < image.rgba.size(); t += 4) coverage += image.rgba[t] / 255.0;
      EXPECT_NEAR(coverage * texel * texel, std::numbers::pi, 0.02) << "view " << image.view;
      // The nearest point of a sphere is one radius towards the viewer.
      EXPECT_NEAR(image.depthMax * cellHalfSide(directory.model.grid, root.key), 1.0, 0.02);
    }
  }
  EXPECT_EQ(views, 42);
}

TEST_F(BuildPack, StreamedLeavesBakeTheSameViewsAsGatheredOnes) {
  const auto path = write("sphere.obj", sphereObj(40, 1, glm::dvec3(0)));
  const BuildOptions options = smallLeaves();
  const std::unique_ptr<MeshReader> mesh = openMesh(path).value();
  Progress silent(false);
  const Partition partition =
      partitionMesh(*mesh, options.settings, {directory_, 1, kMinPartitionMemoryBytes}, silent).value();
  CellTree tree = cellTreeOf(partition.leaves, partition.triangles);
  tree.cells[0].form = options.settings.form;
  const Model model{partition.grid, partition.bounds, options.settings, false, false};
  const std::vector<ViewMask> all;
  MemoryGate gate(uint64_t{1} << 30);
  WorkClock clock;
  // memoryOfThread: little enough that the leaves pass several times, for a few views each.
  const auto views = [&](const char* name, uint64_t gatherTriangles) {
    std::filesystem::create_directories(directory_ / name);
    const auto store = CellStore::open(directory_ / name, 0).value();
    const BuildContext context{model, tree, partition, all, false, *store, gate, 30'000'000, clock};
    EXPECT_TRUE(bakeBatch(context, {0, 0, 21}, nullptr, gatherTriangles));
    return store->views(0).value();
  };
  const std::vector<EncodedView> gathered = views("gathered", kGatherTriangles);
  EXPECT_EQ(gathered.size(), 42u);
  EXPECT_TRUE(gathered == views("streamed", 0));
}

TEST_F(BuildPack, AFailureLeavesTheOlderPackWhole) {
  const auto good = write("sphere.obj", sphereObj(10, 1, glm::dvec3(0)));
  ASSERT_TRUE(build(good, "model.far"));
  const std::string before = bytesOf("model.far");
  const auto bad = write("bad.obj", "v 0 0 0\n");
  ASSERT_FALSE(build(bad, "model.far"));
  EXPECT_EQ(bytesOf("model.far"), before);
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(directory_), {}), 3) << "no temporary file is left";
}

TEST_F(BuildPack, MeaninglessSettingsAreMisuse) {
  const auto mesh = write("sphere.obj", sphereObj(4, 1, glm::dvec3(0)));
  const auto kindOf = [&](auto change) {
    BuildOptions options;
    change(options.settings);
    const auto result = build(mesh, "never.far", options);
    return result ? ErrorKind::io : result.error().kind;
  };
  EXPECT_EQ(kindOf([](BuildSettings& s) { s.form.views = 43; }), ErrorKind::invalidArgument);
  EXPECT_EQ(kindOf([](BuildSettings& s) { s.form.imageSize = 100; }), ErrorKind::invalidArgument);
  EXPECT_EQ(kindOf([](BuildSettings& s) { s.samples = 5; }), ErrorKind::invalidArgument);
  EXPECT_EQ(kindOf([](BuildSettings& s) { s.leafTriangles = 0; }), ErrorKind::invalidArgument);
  for (const int error : {-1, 9})
    EXPECT_EQ(kindOf([&](BuildSettings& s) { s.viewError = error; }), ErrorKind::invalidArgument) << error;
  EXPECT_EQ(kindOf([](BuildSettings& s) { s.metresPerUnit = -1; }), ErrorKind::invalidArgument);
}

TEST_F(BuildPack, OneTriangleIsAModel) {
  const auto mesh = write("one.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  const Result<BuildResult> built = build(mesh, "one.far");
  ASSERT_TRUE(built) << built.error().message;
  EXPECT_TRUE(PackFile::open(directory_ / "one.far"));
}

}  // namespace
}  // namespace farcell
