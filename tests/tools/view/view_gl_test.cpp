// The program farcell-view, as a person runs it: under an Xvfb, with xdotool's hand on the keys.
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <glm/geometric.hpp>
#include <nlohmann/json.hpp>
#include <thread>

#include "cache/base/file.h"
#include "runtime/camera/camera.h"
#include "tests/support/display.h"
#include "tests/support/synthetic_pack.h"
#include "tools/image/png.h"

namespace farcell {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

constexpr std::chrono::seconds kPatience{60};  // sanitizers and a loaded machine are slow

int exitCode(int status) { return WIFEXITED(status) ? WEXITSTATUS(status) : -1; }

class ViewProgram : public testing::Test {
 protected:
  void SetUp() override {
    directory_ = fs::temp_directory_path() / fmt::format("farcell_view_{}", static_cast<int>(getpid()));
    fs::create_directory(directory_);
    const auto written = writeSyntheticPack(directory_ / "a.far", sphereTriangles({100, 0, 0}, 5, 3, 0x0040a0ff),
                                            {.level = 1, .views = 12, .imageSize = 32, .samplesPerEdge = 1});
    ASSERT_TRUE(written) << written.error().message;
  }
  void TearDown() override { fs::remove_all(directory_); }

  // In the test's directory; outputs go to files `out` and `err`.
  int shell(const std::string& command) const {
    return exitCode(std::system(fmt::format("cd {} && {} >out 2>err", directory_.string(), command).c_str()));
  }
  int view(const std::string& arguments) const {
    return shell(fmt::format("DISPLAY={} timeout 120 {}/farcell-view {}", display_ ? display_->name() : "",
                             FARCELL_PROGRAMS_DIR, arguments));
  }
  int render(const std::string& arguments) const {
    return shell(fmt::format("{}/farcell-render {}", FARCELL_PROGRAMS_DIR, arguments));
  }
  std::string text(const std::string& name) const { return readTextFile(directory_ / name, 1 << 20).value_or(""); }
  bool startDisplay() {
    display_ = TestDisplay::start();
    return display_ != nullptr;
  }

  fs::path directory_;
  std::unique_ptr<TestDisplay> display_;
};

TEST_F(ViewProgram, withoutADisplayItSaysSoAndFails) {
  EXPECT_EQ(shell(fmt::format("env -u DISPLAY -u WAYLAND_DISPLAY {}/farcell-view a.far", FARCELL_PROGRAMS_DIR)), 1);
  EXPECT_EQ(text("err"), "farcell-view: no window: DISPLAY is not set; `farcell render` draws without one\n");
  EXPECT_EQ(shell(fmt::format("env -u WAYLAND_DISPLAY DISPLAY=:65432 {}/farcell-view a.far", FARCELL_PROGRAMS_DIR)), 1);
  EXPECT_NE(text("err").find("no window: "), std::string::npos) << text("err");
}

TEST_F(ViewProgram, misuseExitsWith2AndABadPackWith1BeforeAnyWindow) {
  for (const std::string arguments : {"", "a.far --size 0x5", "a.far --json -", "a.far --frames 0", "a.far --kind C",
                                      "a.far --camera-name a", "a.far --background red", "a.far --light headlight"})
    EXPECT_EQ(view(arguments), 2) << arguments;
  EXPECT_EQ(view("none.far"), 1);
  EXPECT_NE(text("err").find("none.far"), std::string::npos);
}

// The worst difference of two pictures' bytes; -1 when they are not of one shape.
int worstDifference(const fs::path& a, const fs::path& b) {
  const auto first = readPng(a, 1 << 20), second = readPng(b, 1 << 20);
  if (!first || !second || first->width != second->width || first->pixels.size() != second->pixels.size()) return -1;
  int worst = 0;
  for (size_t i = 0; i < first->pixels.size(); ++i)
    worst = std::max(worst, std::abs(first->pixels[i] - second->pixels[i]));
  return worst;
}

TEST_F(ViewProgram, aScreenshotIsThePictureThatRenderDraws) {
  if (!startDisplay()) GTEST_SKIP() << "Xvfb is not installed";
  ASSERT_TRUE(writeTextFile(
      directory_ / "c.json",
      R"({"cameras":[{"name":"a","position":[90,3,2],"target":[100,0,0.5],"up":[0,0,1],"fovYDeg":50}]})"));
  for (const std::string options : {"--samples 4", "--samples 8 --camera c.json", "--samples 16 --mode full",
                                    "--samples 1 --kind flat --mode impostors"}) {
    const std::string all = "a.far --size 320x200 --background 10,20,30 " + options;
    ASSERT_EQ(view(all + " --screenshot v.png"), 0) << text("err");
    ASSERT_EQ(render(all + " -o r.png"), 0) << text("err");
    const int worst = worstDifference(directory_ / "v.png", directory_ / "r.png");
    EXPECT_GE(worst, 0) << options;
    EXPECT_LE(worst, 3) << options;  // 16 samples: rounded four times
  }
}

TEST_F(ViewProgram, framesAreDrawnTimedAndReported) {
  if (!startDisplay()) GTEST_SKIP() << "Xvfb is not installed";
  ASSERT_EQ(view("a.far --size 200x100 --frames 7 --json - --screenshot s.png"), 0) << text("err");
  const auto figures = nlohmann::json::parse(text("out"), nullptr, false);
  ASSERT_TRUE(figures.is_object()) << text("out");
  ASSERT_EQ(figures["frames"].size(), 7u);
  EXPECT_EQ(figures["width"], 200);
  EXPECT_EQ(figures["height"], 100);
  EXPECT_LE(figures["medianMs"].get<double>(), figures["p95Ms"].get<double>());
  EXPECT_LE(figures["p95Ms"].get<double>(), figures["maxMs"].get<double>());
  EXPECT_GT(figures["medianMs"].get<double>(), 0);
  EXPECT_NE(text("err").find("7 frames of 200 x 100"), std::string::npos) << text("err");
  EXPECT_TRUE(readPng(directory_ / "s.png", 200 * 100));
}

// A viewer that is open, and a hand for its keys.
class OpenViewer : public ViewProgram {
 protected:
  bool open(const std::string& arguments) {
    if (std::system("command -v xdotool >/dev/null") != 0 || !startDisplay()) return false;
    const std::string command =
        fmt::format("cd {} && DISPLAY={} timeout 300 {}/farcell-view {} >out 2>err; echo $? >code", directory_.string(),
                    display_->name(), FARCELL_PROGRAMS_DIR, arguments);
    viewer_ = std::thread([command] { static_cast<void>(std::system(command.c_str())); });
    EXPECT_EQ(hand("search --sync --onlyvisible --name 'a.far'"), 0) << text("err");
    return true;
  }
  void TearDown() override {
    if (viewer_.joinable()) {
      hand("key Escape");
      viewer_.join();
    }
    ViewProgram::TearDown();
  }
  int hand(const std::string& words) const {
    return exitCode(std::system(fmt::format("DISPLAY={} timeout {} xdotool {} >{}/hand 2>&1", display_->name(),
                                            kPatience.count(), words, directory_.string())
                                    .c_str()));
  }
  template <class Condition>
  bool await(const Condition& condition) const {
    const auto start = Clock::now();
    while (!condition()) {
      if (Clock::now() - start > kPatience) return false;
      std::this_thread::sleep_for(std::chrono::milliseconds(20));
    }
    return true;
  }
  std::vector<fs::path> captures() const {
    std::vector<fs::path> found;
    for (const auto& entry : fs::directory_iterator(directory_))
      if (entry.path().extension() == ".json") found.push_back(entry.path());
    std::sort(found.begin(), found.end());  // names sort by time
    return found;
  }
  // P, and the camera it saves.
  Camera savedCamera() {
    const size_t before = captures().size();
    hand("key p");
    EXPECT_TRUE(await([&] { return captures().size() > before; })) << text("err");
    const auto cameras = readCameras(captures().back());
    EXPECT_TRUE(cameras) << cameras.error().message;
    return cameras ? cameras->front() : Camera{};
  }
  // Asks until two pictures in a row are from one place.
  Camera restingCamera() {
    Camera last = savedCamera();
    for (int i = 0; i < 50; ++i) {
      const Camera next = savedCamera();
      if (next.position == last.position && next.target == last.target) return next;
      last = next;
    }
    ADD_FAILURE() << "does not come to rest";
    return last;
  }
  std::thread viewer_;
};

TEST_F(OpenViewer, keysMoveTheCameraFitBringsItBackAndEscapeQuits) {
  if (!open("a.far --size 320x200")) GTEST_SKIP() << "Xvfb or xdotool is not installed";
  const Camera start = restingCamera();
  hand("keydown d sleep 0.3 keyup d");
  const Camera moved = restingCamera();
  EXPECT_GT(glm::length(moved.position - start.position), 0.5);
  hand("key f");
  const Camera fitted = restingCamera();
  EXPECT_LT(glm::length(fitted.target - start.target), 0.05);  // the middle of the model again
  hand("key Escape");
  EXPECT_TRUE(await([&] { return !text("code").empty(); }));
  EXPECT_EQ(text("code"), "0\n") << text("err");
}

TEST_F(OpenViewer, whatItSavesIsWhatItSaysAndRenderDrawsItAgain) {
  if (!open("a.far --size 320x200 --background 9,9,9")) GTEST_SKIP() << "Xvfb or xdotool is not installed";
  hand("key m");  // auto -> impostors
  hand("key k");  // A -> B
  hand("key k");  // B -> flat
  EXPECT_EQ(hand("search --sync --onlyvisible --name 'a.far . orbit, impostors, flat'"), 0);
  restingCamera();
  const fs::path saved = captures().back();
  const std::string picture = fs::path(saved).replace_extension(".png");
  EXPECT_TRUE(await([&] { return text("out").find(saved.filename().string()) != std::string::npos; }));
  EXPECT_NE(text("out").find("--mode impostors --kind flat"), std::string::npos) << text("out");
  ASSERT_EQ(
      render(fmt::format("a.far --camera {} --size 320x200 --mode impostors --kind flat --samples 4 --background 9,9,9 "
                         "-o again.png >render.out 2>render.err #",
                         saved.string())),
      0);
  const int worst = worstDifference(picture, directory_ / "again.png");
  EXPECT_GE(worst, 0);
  EXPECT_LE(worst, 2);
}

TEST_F(OpenViewer, keysMoveTheLightOfARelightablePackAndWhatItSavesSaysSo) {
  ASSERT_TRUE(writeSyntheticPack(directory_ / "a.far", sphereTriangles({100, 0, 0}, 5, 3, 0x0040a0ff),
                                 {.level = 1, .views = 12, .imageSize = 32, .lighting = Lighting::relightable}));
  if (!open("a.far --size 320x200")) GTEST_SKIP() << "Xvfb or xdotool is not installed";
  hand("key Up");
  savedCamera();
  EXPECT_TRUE(await([&] { return text("out").find(" --sun 39.8056,46.8685") != std::string::npos; })) << text("out");
  hand("key l");
  savedCamera();
  EXPECT_TRUE(await([&] { return text("out").find(" --light headlight") != std::string::npos; })) << text("out");
}

TEST_F(OpenViewer, theLightOfABakedPackStaysAndTheViewerSaysWhy) {
  if (!open("a.far --size 320x200")) GTEST_SKIP() << "Xvfb or xdotool is not installed";
  hand("key l");
  EXPECT_TRUE(await([&] { return text("err").find("--lighting relightable") != std::string::npos; })) << text("err");
  savedCamera();
  EXPECT_EQ(text("out").find("--light"), std::string::npos) << text("out");
}

}  // namespace
}  // namespace farcell
