// Frames laid over what is behind the model, as a window shows them.
#include <gtest/gtest.h>

#include "runtime/draw/frame_target.h"
#include "runtime/draw/sample_mean.h"
#include "tests/runtime/renderer_fixture.h"

namespace farcell {
namespace {

constexpr Backdrop kStripes = {{0, 0, 250}, {0, 250, 0}, {250, 0, 0}};

DrawnPack sphere() {
  return openDrawn(sphereTriangles({0, 0, 0}, 5, 3, 0x00ffffff),
                   {.level = 1, .views = 12, .imageSize = 32, .samplesPerEdge = 1});
}

std::array<int, 3> at(const FrameImage& image, int x, int y) {
  const size_t first = static_cast<size_t>(y * image.width + x) * 4;
  return {image.rgba[first], image.rgba[first + 1], image.rgba[first + 2]};
}

TEST(Backdrop, ofOneColourIsTheOfflinePictureOverThatColour) {
  DrawnPack pack = sphere();
  const Camera camera = lookAt({20, 3, 4}, {0, 0, 0});
  for (const int samples : {1, 4, 16}) {
    const RenderSettings settings = sized(120, 90, RenderMode::full, samples);
    FrameImage image;
    pack.draw(camera, settings, image);
    const auto expected = overBackground(image.rgba, {9, 200, 33});
    const auto shown = pack.renderer->capture(camera, settings, {{9, 200, 33}, {9, 200, 33}, {9, 200, 33}});
    ASSERT_TRUE(shown) << shown.error().message;
    int worst = 0;
    for (size_t pixel = 0; pixel < expected.size() / 3; ++pixel)
      for (size_t channel = 0; channel < 3; ++channel)
        worst = std::max(worst, std::abs(shown->rgba[4 * pixel + channel] - expected[3 * pixel + channel]));
    EXPECT_LE(worst, 1) << samples;
  }
}

TEST(Backdrop, aSkyIsUprightByTheModelWhereverTheCameraLooks) {
  DrawnPack pack = sphere();
  const RenderSettings settings = sized(64, 64, RenderMode::full);
  const auto centre = [&](glm::dvec3 direction) {
    const auto shown = pack.renderer->capture(lookAt({50, 50, 50}, glm::dvec3(50) + direction), settings, kStripes);
    if (!shown) throw std::runtime_error(shown.error().message);
    return at(*shown, 32, 32);
  };
  EXPECT_GT(centre({0, 0.001, 1})[2], 240);   // the zenith
  EXPECT_GT(centre({0, 0.001, -1})[0], 240);  // below
  EXPECT_GT(centre({1, 0, 0})[1], 170);       // about the horizon
  EXPECT_GT(centre({0, 1, 0.5})[2], centre({0, 1, 0.1})[2]);
  const auto level = pack.renderer->capture(lookAt({50, 50, 50}, {60, 50, 50}), settings, kStripes);
  ASSERT_TRUE(level);
  EXPECT_GT(at(*level, 32, 2)[2], 50);  // row 0 is the top: sky there, not ground
  EXPECT_EQ(at(*level, 32, 2)[0], 0);
  EXPECT_GT(at(*level, 32, 61)[0], 50);
}

TEST(Backdrop, aCameraThatRestsIsShownThePictureOf64SamplesInAFrameForEachPassButTheFirst) {
  DrawnPack pack = sphere();
  RenderSettings settings = sized(120, 90, RenderMode::full, 4), finer = sized(120, 90, RenderMode::full, 64);
  const FrameTarget window(120, 90, 1, false);
  const auto shownFrom = [&](const Camera& camera) {
    const auto stats = pack.renderer->show(camera, settings, kStripes, window.framebuffer());
    if (!stats) throw std::runtime_error(stats.error().message);
    return stats->settled;
  };
  for (const auto& [height, mode] :  // a camera that moves on begins anew
       {std::pair{4.0, RenderMode::full}, {5.0, RenderMode::full}, {5.0, RenderMode::impostors}}) {
    const Camera camera = lookAt({20, 3, height}, {0, 0, 0});
    settings.selection.mode = finer.selection.mode = mode;
    const auto first = pack.renderer->capture(camera, settings, kStripes);
    const auto last = pack.renderer->capture(camera, finer, kStripes);
    ASSERT_TRUE(first && last);
    ASSERT_NE(first->rgba, last->rgba);
    EXPECT_FALSE(shownFrom(camera));
    EXPECT_EQ(window.readColour(), first->rgba);
    for (int frame = 1; frame + 1 < kMostPasses; ++frame) EXPECT_FALSE(shownFrom(camera));
    for (int frame = 0; frame < 2; ++frame) {
      EXPECT_TRUE(shownFrom(camera));
      EXPECT_EQ(window.readColour(), last->rgba);
    }
  }
}

TEST(Backdrop, aPictureThatCannotBeIsRefused) {
  DrawnPack pack = sphere();
  const auto shown = pack.renderer->capture(lookAt({20, 3, 4}, {0, 0, 0}), sized(0, 64, RenderMode::full), kStripes);
  ASSERT_FALSE(shown);
  EXPECT_EQ(shown.error().kind, ErrorKind::invalidArgument);
}

}  // namespace
}  // namespace farcell
