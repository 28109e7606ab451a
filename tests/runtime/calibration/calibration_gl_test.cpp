#include "runtime/calibration/calibration.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <stdexcept>

#include "cache/base/file.h"
#include "cache/pack/pack_file.h"
#include "runtime/calibration/ball_pack.h"
#include "runtime/cost/cost_store.h"

namespace farcell {
namespace {

CostModel costsOf(GlContext& context, bool again) {
  const auto costs = machineCosts(context, again);
  if (!costs) throw std::runtime_error(costs.error().message);
  return *costs;
}

class Calibration : public testing::Test {
 protected:
  // Made before the directory of caches changes: drivers keep their shaders in the user's.
  static GlContext& context() {
    static Result<GlContext> made = GlContext::createHeadless();
    if (!made) throw std::runtime_error(made.error().message);
    return *made;
  }
  void SetUp() override {
    context();
    directory_ =
        std::filesystem::temp_directory_path() / fmt::format("farcell_calibration_{}", static_cast<int>(getpid()));
    std::filesystem::create_directories(directory_);
    setenv("XDG_CACHE_HOME", directory_.c_str(), 1);
  }
  void TearDown() override {
    std::filesystem::remove_all(directory_);
    unsetenv("XDG_CACHE_HOME");
  }
  std::filesystem::path directory_;
};

TEST_F(Calibration, theBallIsAWholePack) {
  ASSERT_TRUE(writeBallPack(directory_ / "ball.far"));
  const auto pack = PackFile::open(directory_ / "ball.far");
  ASSERT_TRUE(pack) << pack.error().message;
  for (const Error& error : pack->verify(10, {})) ADD_FAILURE() << error.message;
  EXPECT_EQ(pack->directory().cells.size(), 9u);
}

TEST_F(Calibration, isKeptAndMeasuredAgainWhereTheFileIsOfAnotherForm) {
  const auto path = costsPath(context().renderer());
  ASSERT_TRUE(path);
  CostModel made;
  made.draws.fill({1, 2, 3, 4, 5});
  ASSERT_TRUE(saveCosts(*path, made, context().renderer()));
  EXPECT_TRUE(costsOf(context(), false) == made);
  ASSERT_TRUE(writeTextFile(*path, "farcell-costs -1\nnonsense\n"));
  const CostModel measured = costsOf(context(), false);
  EXPECT_FALSE(measured == made);
  for (const DrawCosts& draw : measured.draws) EXPECT_GT(expectedMs(draw, {9e5, 1e5, 9e5, 100, 9e5}), 0);
  EXPECT_TRUE(costsOf(context(), false) == measured);
}

TEST_F(Calibration, whereNothingCanBeKeptIsNoError) {
  ASSERT_TRUE(writeTextFile(directory_ / "file", "no directory"));
  setenv("XDG_CACHE_HOME", (directory_ / "file").c_str(), 1);
  EXPECT_TRUE(machineCosts(context(), true));
}

}  // namespace
}  // namespace farcell
