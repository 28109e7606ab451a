// Builds that measure some cells, and what they expect of the others.
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <numbers>
#include <random>

#include "cache/base/file.h"
#include "cache/pack/pack_file.h"
#include "preprocess/build/build.h"
#include "preprocess/build/measure_job.h"

namespace farcell {
namespace {

// A ball whose surface is smooth on one side and rougher and rougher towards the other: cells that are not alike.
std::string roughBall(int rings) {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> uniform(-1, 1);
  std::string text;
  const int columns = 2 * rings;
  for (int i = 0; i <= rings; ++i)
    for (int j = 0; j < columns; ++j) {
      const double polar = std::numbers::pi * i / rings, azimuth = 2 * std::numbers::pi * j / columns;
      const double rough = 0.08 * (1 - std::cos(polar)) * uniform(random) * (i % rings != 0);
      text += fmt::format("v {:.9g} {:.9g} {:.9g}\n", (1 + rough) * std::sin(polar) * std::cos(azimuth),
                          (1 + rough) * std::sin(polar) * std::sin(azimuth), (1 + rough) * std::cos(polar));
    }
  for (int i = 0; i < rings; ++i)
    for (int j = 0; j < columns; ++j) {
      const int a = i * columns + j + 1, b = i * columns + (j + 1) % columns + 1;
      text += fmt::format("f {} {} {}\nf {} {} {}\n", a, a + columns, b, b, a + columns, b + columns);
    }
  return text;
}

class MeasuredBuild : public testing::Test {
 protected:
  void SetUp() override {
    directory_ = std::filesystem::path(testing::TempDir()) / fmt::format("farcell-measured-{}", ::getpid());
    std::filesystem::create_directories(directory_);
    std::ofstream(mesh()) << roughBall(32);
  }
  void TearDown() override { std::filesystem::remove_all(directory_); }

  std::filesystem::path mesh() const { return directory_ / "ball.obj"; }
  BuildResult build(Measure measure, int threads = 0, uint64_t memoryBytes = kDefaultMemoryBytes,
                    int imageSize = 16) const {
    BuildOptions options;
    options.settings.leafTriangles = 200;
    options.settings.form.imageSize = imageSize;
    options.settings.samples = 4;
    options.settings.form.views = 12;
    options.settings.measure = measure;
    options.threads = threads;
    options.memoryBytes = memoryBytes;
    Progress silent(false);
    const std::filesystem::path file = mesh();
    Result<BuildResult> built = buildPack({&file, 1}, pack(), options, silent);
    if (!built) throw std::runtime_error(built.error().message);
    return *std::move(built);
  }
  std::filesystem::path pack() const { return directory_ / "ball.far"; }
  std::string bytes() const { return readTextFile(pack(), uint64_t{1} << 30).value(); }

  std::filesystem::path directory_;
};

TEST_F(MeasuredBuild, tellsOfCellsThatWereNotMeasuredWhatMeasuringThemGives) {
  constexpr int kImageSize = 32;
  constexpr int kLeastEdge = 16;  // of a picture, pixels: smaller ones hardly have pixels of their own
  const BuildResult sample = build(Measure::sample, 0, kDefaultMemoryBytes, kImageSize);
  const BuildResult all = build(Measure::all, 0, kDefaultMemoryBytes, kImageSize);
  ASSERT_GT(all.measured.cells, 2 * sample.measured.cells);
  EXPECT_GE(sample.measured.cells, kLeastMeasured);
  const double units = sample.measured.unit / all.measured.unit;
  for (const ErrorWay way : {ErrorWay::mesh, ErrorWay::depthCorrected, ErrorWay::blended}) {
    for (size_t scale = 0; scale < kErrorScales; ++scale) {
      std::vector<double> off, without;  // and where one error is told for all
      double mean = 0;
      const auto& expected = sample.directory.cells;
      const auto& measured = all.directory.cells;
      const auto codeOf = [&](const CellRecord& cell) { return cell.errors.codes[static_cast<size_t>(way)][scale]; };
      for (const CellRecord& cell : measured)
        if (codeOf(cell) > 0) without.push_back(errorFromCode(codeOf(cell)));
      for (const double error : without) mean += std::log2(error) / static_cast<double>(without.size());
      for (double& error : without) error = std::abs(std::exp2(mean) / error - 1);
      for (size_t cell = 0; cell < expected.size(); ++cell)
        if (codeOf(expected[cell]) > 0 && codeOf(measured[cell]) > 0)
          off.push_back(
              std::abs(units * errorFromCode(codeOf(expected[cell])) / errorFromCode(codeOf(measured[cell])) - 1));
      const auto median = [](std::vector<double>& values) {
        std::nth_element(values.begin(), values.begin() + static_cast<ptrdiff_t>(values.size() / 2), values.end());
        return values[values.size() / 2];
      };
      ASSERT_GT(off.size(), 40u);
      if (kImageSize * kErrorTexelPixels[scale] >= kLeastEdge) {
        EXPECT_LT(median(off), 0.4) << static_cast<size_t>(way) << " at " << kErrorTexelPixels[scale];
      }
      EXPECT_LT(median(off), median(without)) << static_cast<size_t>(way) << " at " << kErrorTexelPixels[scale];
      EXPECT_GT(sample.measured.apart[static_cast<size_t>(way)][scale].ninetieth, 0);
    }
  }
}

TEST_F(MeasuredBuild, hasTheSameBytesForAnyThreadsAndMemory) {
  build(Measure::sample, 1);
  const std::string one = bytes();
  build(Measure::sample, 3, kMinMemoryBytes);
  EXPECT_EQ(bytes(), one);
  build(Measure::off);
  EXPECT_NE(bytes(), one);
}

// Of leaves that are few, so that there are few kinds of cells.
TEST_F(MeasuredBuild, choosesTheSameFormsForAnyThreadsAndMemory) {
  BuildOptions options;
  options.settings.leafTriangles = 1000;
  options.settings.samples = 1;
  options.settings.form = {42, 64};
  const auto built = [&] {
    Progress silent(false);
    const std::filesystem::path file = mesh();
    return buildPack({&file, 1}, pack(), options, silent).value();
  };
  const BuildResult fixed = built();
  EXPECT_TRUE(fixed.measured.forms.kinds.empty());
  options.settings.forms = Forms::chosen;
  options.threads = 1;
  const BuildResult chosen = built();
  const std::string one = bytes();
  options.threads = 3;
  options.memoryBytes = kMinMemoryBytes;
  built();
  EXPECT_EQ(bytes(), one);

  EXPECT_TRUE(PackFile::open(pack())->verify(10, nullptr).empty());
  EXPECT_LE(chosen.directory.report.impostorBytes, fixed.directory.report.impostorBytes);
  ASSERT_FALSE(chosen.measured.forms.kinds.empty());
  for (const KindForms& kind : chosen.measured.forms.kinds)
    for (const CellRecord& cell : chosen.directory.cells)
      if (kindOf(cell) == kind.kind) {
        EXPECT_EQ(cell.form, candidateForm(kind.chosen));
      }
}

TEST_F(MeasuredBuild, withoutMeasuringKnowsNoErrors) {
  const BuildResult built = build(Measure::off);
  EXPECT_EQ(built.measured.cells, 0u);
  for (const CellRecord& cell : built.directory.cells) EXPECT_EQ(cell.errors, ErrorTable());
}

TEST(MeasureJobs, areSpreadOverLevelsAndDensities) {
  CellTree tree;
  for (uint32_t level = 1; level < 5; ++level)
    for (uint32_t i = 0; i < 100 * level; ++i) {
      CellRecord cell;
      cell.key.level = level;
      cell.triangles = 10 + 7 * ((31 * i) % (100 * level));
      tree.cells.push_back(cell);
    }
  const std::vector<uint32_t> jobs = cellsToMeasure(tree, Measure::sample);
  ASSERT_EQ(jobs.size(), kUsuallyMeasured);
  std::array<int, 5> byLevel{};
  for (const uint32_t cell : jobs) ++byLevel[tree.cells[cell].key.level];
  EXPECT_EQ(byLevel, (std::array<int, 5>{0, 2, 5, 7, 10})) << "as there are cells";
  const auto most = std::max_element(jobs.begin(), jobs.end(), [&](uint32_t a, uint32_t b) {
    return tree.cells[a].triangles < tree.cells[b].triangles;
  });
  EXPECT_GT(tree.cells[*most].triangles, 2500u);
  EXPECT_EQ(cellsToMeasure(tree, Measure::all).size(), tree.cells.size());
}

}  // namespace
}  // namespace farcell
