// The program farcell-render, as a person runs it.
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "cache/base/file.h"
#include "tests/support/synthetic_pack.h"
#include "tools/image/png.h"

namespace farcell {
namespace {

class RenderProgram : public testing::Test {
 protected:
  void SetUp() override {
    directory_ = std::filesystem::temp_directory_path() / fmt::format("farcell_render_{}", static_cast<int>(getpid()));
    std::filesystem::create_directory(directory_);
    const auto written = writeSyntheticPack(directory_ / "a.far", sphereTriangles({100, 0, 0}, 5, 3, 0x00ffffff),
                                            {.level = 1, .views = 12, .imageSize = 32, .samplesPerEdge = 1});
    ASSERT_TRUE(written) << written.error().message;
  }
  void TearDown() override { std::filesystem::remove_all(directory_); }

  // Exit code; both outputs go to files `out` and `err`.
  int run(const std::string& arguments) const {
    const std::string command =
        fmt::format("cd {} && {}/farcell-render {} >out 2>err", directory_.string(), FARCELL_PROGRAMS_DIR, arguments);
    const int status = std::system(command.c_str());
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  }
  std::string text(const std::string& name) const { return readTextFile(directory_ / name, 1 << 20).value_or(""); }

  std::filesystem::path directory_;
};

TEST_F(RenderProgram, drawsAnOverviewOverTheBackground) {
  ASSERT_EQ(run("a.far --size 160x90 --background 10,20,30 --json - -o a.png"), 0) << text("err");
  const auto picture = readPng(directory_ / "a.png", 160 * 90);
  ASSERT_TRUE(picture) << picture.error().message;
  EXPECT_EQ(picture->width, 160);
  EXPECT_EQ(picture->height, 90);
  EXPECT_EQ((std::vector<uint8_t>(picture->pixels.begin(), picture->pixels.begin() + 3)),
            (std::vector<uint8_t>{10, 20, 30}));
  const size_t centre = (45 * 160 + 80) * 3;
  EXPECT_EQ(picture->pixels[centre], picture->pixels[centre + 2]);  // white under white light, not the background
  EXPECT_GT(picture->pixels[centre], 60);
  const auto figures = nlohmann::json::parse(text("out"), nullptr, false);
  ASSERT_TRUE(figures.is_object()) << text("out");
  EXPECT_EQ(figures["frames"].size(), 1u);
  EXPECT_GT(figures["frames"][0]["bytesRead"].get<uint64_t>(), 0u);
}

TEST_F(RenderProgram, refusesAnotherLightThanThatOfABakedPack) {
  for (const std::string light : {"--light headlight", "--sun 120,30", "--sun 0", "--sun 1,2 --light headlight"}) {
    EXPECT_EQ(run("a.far --size 64x48 -o a.png " + light), 2) << light;
    EXPECT_FALSE(text("err").empty()) << light;
  }
  ASSERT_TRUE(writeSyntheticPack(directory_ / "b.far", sphereTriangles({100, 0, 0}, 5, 3, 0x00ffffff),
                                 {.level = 1, .views = 12, .imageSize = 32, .lighting = Lighting::relightable}));
  EXPECT_EQ(run("b.far --size 64x48 -o b.png --light headlight"), 0) << text("err");
  EXPECT_EQ(run("b.far --size 64x48 -o b.png --sun 120,30"), 0) << text("err");
}

TEST_F(RenderProgram, repeatedFramesReadThePackOnce) {
  ASSERT_EQ(run("a.far --size 64x48 --mode full --repeat 3 --json stats.json"), 0) << text("err");
  const auto figures = nlohmann::json::parse(text("stats.json"), nullptr, false);
  ASSERT_EQ(figures["frames"].size(), 3u);
  EXPECT_GT(figures["frames"][0]["bytesRead"].get<uint64_t>(), 0u);
  EXPECT_EQ(figures["frames"][2]["bytesRead"].get<uint64_t>(), 0u);
  EXPECT_GT(figures["frames"][2]["triangles"].get<uint64_t>(), 511u);
}

TEST_F(RenderProgram, aQualityIsItsOptionsTogetherAndAnOptionHasTheLastWord) {
  const auto picture = [&](const std::string& options) {
    EXPECT_EQ(run("a.far --size 64x48 -o q.png " + options), 0) << text("err");
    return text("q.png");
  };
  const std::string high = picture("--quality high");
  EXPECT_EQ(high, picture("--texel-pixels 0.35 --mesh-pixels 0.5 --samples 16"));
  EXPECT_NE(high, picture(""));
  EXPECT_EQ(picture("--quality default"), picture(""));
  EXPECT_EQ(picture("--samples 4 --quality high"), picture("--texel-pixels 0.35 --mesh-pixels 0.5 --samples 4"));
  EXPECT_EQ(picture("--quality default"), picture("--samples 8"));
  EXPECT_EQ(run("a.far --quality best -o q.png"), 2);
}

TEST_F(RenderProgram, namedCamerasAreFoundOrRefused) {
  ASSERT_TRUE(
      writeTextFile(directory_ / "c.json",
                    R"({"cameras":[{"name":"away","position":[0,0,0],"target":[-1,0,0],"up":[0,0,1],"fovYDeg":40},
                                {"name":"at","position":[0,0,0],"target":[1,0,0],"up":[0,0,1],"fovYDeg":8}]})"));
  const auto centreOf = [&](const std::string& name) {
    EXPECT_EQ(run(fmt::format("a.far --camera c.json --camera-name {} --size 64x48 --background 1,2,3 -o c.png", name)),
              0);
    const auto picture = readPng(directory_ / "c.png", 64 * 48);
    return picture ? static_cast<int>(picture->pixels[(24 * 64 + 32) * 3]) : -1;
  };
  EXPECT_EQ(centreOf("away"), 1);
  EXPECT_GT(centreOf("at"), 60);
  EXPECT_EQ(run("a.far --camera c.json --camera-name none -o c.png"), 2);
  EXPECT_NE(text("err").find("no camera is named 'none'"), std::string::npos);
}

TEST_F(RenderProgram, whatColoursShowIsToldInAList) {
  for (const std::string show : {"cells", "billboards", "levels", "kinds", "error", "depth", "normals"}) {
    ASSERT_EQ(run("a.far --size 64x48 --json - -o s.png --show " + show), 0) << text("err");
    const auto figures = nlohmann::json::parse(text("out"), nullptr, false);
    EXPECT_EQ(figures["show"], show);
    ASSERT_GT(figures["legend"].size(), 0u) << show;
    for (const auto& entry : figures["legend"]) {
      EXPECT_EQ(entry["colour"].size(), 3u);
      EXPECT_NE(text("err").find(entry["meaning"].get<std::string>()), std::string::npos);
    }
  }
  ASSERT_EQ(run("a.far --size 64x48 --json -"), 0) << text("err");
  EXPECT_FALSE(nlohmann::json::parse(text("out"), nullptr, false).contains("legend"));
  EXPECT_EQ(run("a.far -o s.png --show beauty"), 2);
  for (const std::string show : {"cells", "billboards", "levels", "kinds", "error", "depth", "normals", "picture"})
    EXPECT_NE(text("err").find(show), std::string::npos) << text("err");
}

TEST_F(RenderProgram, misuseExitsWith2AndFailureWith1) {
  for (const std::string arguments :
       {"", "a.far", "a.far -o a.png --mode fast", "a.far -o a.png --kind C", "a.far -o a.png --size 0x5",
        "a.far -o a.png --samples 3", "a.far -o a.png --background 1,2,256", "a.far -o a.png --background 1,2",
        "a.far -o a.png --triangle-budget many", "a.far -o a.png --repeat 0"})
    EXPECT_EQ(run(arguments), 2) << arguments;
  EXPECT_EQ(run("none.far -o a.png"), 1);
  EXPECT_NE(text("err").find("none.far"), std::string::npos);
  EXPECT_EQ(run("a.far --size 16x16 -o missing/a.png"), 1);
}

}  // namespace
}  // namespace farcell
