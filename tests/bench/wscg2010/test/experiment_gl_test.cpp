// The whole experiment on a model of two thousand triangles.
#include "tests/bench/wscg2010/measure/experiment.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <fstream>

#include "tests/bench/wscg2010/measure/claims.h"
#include "tests/bench/wscg2010/measure/report.h"
#include "tests/bench/wscg2010/test/samples.h"
#include "tools/image/png.h"

namespace farcell::wscg {
namespace {

class Experiment : public testing::Test {
 protected:
  void SetUp() override {
    directory_ = std::filesystem::temp_directory_path() / fmt::format("farcell_wscg_{}", static_cast<int>(getpid()));
    std::filesystem::create_directories(directory_);
  }
  void TearDown() override { std::filesystem::remove_all(directory_); }

  std::filesystem::path writeModel() const {
    const std::filesystem::path path = directory_ / "ball.obj";
    std::ofstream file(path);
    int vertex = 0;
    for (const Triangle& triangle : test::bumpySphere(4, 0.2f)) {
      for (const glm::vec3& p : triangle.corners) file << "v " << p.x << " " << p.y << " " << p.z << "\n";
      file << "f " << vertex + 1 << " " << vertex + 2 << " " << vertex + 3 << "\n";
      vertex += 3;
    }
    return path;
  }
  ExperimentSettings smallSettings() const {
    ExperimentSettings settings = quickSettings();
    settings.models = {writeModel()};
    settings.output = directory_ / "out";
    settings.depth = 3;
    settings.errors.width = 160;
    settings.errors.height = 120;
    settings.errors.truthSamples = 4;
    settings.times.frames = 2;
    settings.sizes.cells = 1;
    std::erase_if(settings.errors.variants, [](const Variant& v) { return v.depth > 3; });
    return settings;
  }

  std::filesystem::path directory_;
};

void expectSoundErrors(const ErrorResults& errors) {
  const auto mean = [&](const std::string& variant, double (*figure)(const ErrorRow&)) {
    return meanOver(errors, "ball", variant, -1, figure);
  };
  EXPECT_EQ(mean(kTrianglesVariant, toSingle), 0);
  EXPECT_GT(mean(kTrianglesVariant, toTruth), 0);
  EXPECT_LT(mean("depth 3", toSingle), mean("single cell", toSingle));
  EXPECT_LT(mean("depth 3, 1280 images", toSingle), mean("depth 3, 80 images", toSingle));
  EXPECT_LT(mean("depth 3", toSingle), mean("depth 3, perspective 90", toSingle));
  EXPECT_LE(mean("depth 3", holes), mean("depth 3, cut to the cube", holes));
}

void expectSoundSizes(const std::vector<SizeResult>& sizes) {
  ASSERT_EQ(sizes.size(), 3u);
  for (const SizeResult& size : sizes) {
    EXPECT_EQ(size.images, 320u);
    EXPECT_EQ(size.bytes(Coding::raw), 320.0 * 128 * 128 * 4);
    EXPECT_LT(size.bytes(Coding::cropped), size.bytes(Coding::raw));
    for (const Coding coding : {Coding::zlibImages, Coding::zlibCell, Coding::planes, Coding::webp, Coding::xzCell}) {
      EXPECT_LT(size.bytes(coding), size.bytes(Coding::cropped)) << codingName(coding);
      EXPECT_GT(size.bytes(coding), 0) << codingName(coding);
    }
  }
}

TEST_F(Experiment, GivesEveryTableClaimAndPictureOfATinyModel) {
  const ExperimentSettings settings = smallSettings();
  const auto results = runExperiment(settings);
  ASSERT_TRUE(results) << results.error().message;
  expectSoundErrors(results->errors);
  EXPECT_EQ(results->errors.cells.size(), 3u);
  expectSoundSizes(results->sizes);
  ASSERT_EQ(results->times.size(), kSourceCount);
  for (const TimeRow& row : results->times) EXPECT_GT(row.frameMs, 0) << sourceName(row.source);
  ASSERT_EQ(results->near.size(), 1u);
  EXPECT_LT(results->near[0].errorWith, results->near[0].errorWithout);

  ASSERT_TRUE(writeReport(*results, settings, machineFacts()));
  for (const char* name : {"results.md", "errors.csv", "times.csv", "sizes.csv"})
    EXPECT_GT(std::filesystem::file_size(settings.output / name), 100u) << name;
  for (const Claim& claim : judgeClaims(*results, settings)) EXPECT_FALSE(claim.verdict.empty()) << claim.text;
  const auto sheet = readPng(settings.output / "ball" / "sheet.png", 4'000'000);
  ASSERT_TRUE(sheet) << sheet.error().message;
  EXPECT_GT(sheet->width, kSheetColumns * kPictureWidth / 3);
  EXPECT_FALSE(std::filesystem::exists(settings.output / "ball.raw.images"));
}

TEST_F(Experiment, AModelThatIsNotThereOrIsNoneIsAnError) {
  ExperimentSettings settings = smallSettings();
  settings.models = {directory_ / "none.obj"};
  EXPECT_EQ(runExperiment(settings).error().kind, ErrorKind::notFound);
  std::ofstream(directory_ / "empty.obj") << "v 0 0 0\n";
  settings.models = {directory_ / "empty.obj"};
  EXPECT_FALSE(runExperiment(settings));
}

}  // namespace
}  // namespace farcell::wscg
