#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <random>

#include "shaders/shared/shading.h"
#include "tests/runtime/renderer_fixture.h"

namespace farcell {
namespace {

constexpr uint32_t kWhite = 0x00ffffff;

// Pixels that a sphere's silhouette covers in a perspective picture: an ellipse; here centred, so a disc.
double discPixels(double radius, double distance, double fovYRad, int height) {
  const double tanSilhouette = radius / std::sqrt(distance * distance - radius * radius);
  const double pixels = tanSilhouette / (2 * std::tan(fovYRad / 2)) * height;
  return std::numbers::pi * pixels * pixels;
}

TEST(Renderer, aSphereOfTrianglesCoversItsDisc) {
  DrawnPack drawn = openDrawn(sphereTriangles({10, 20, 30}, 2, 5, kWhite), {.level = 1, .withViews = false});
  const Camera camera = lookAt({10 + 12, 20, 30}, {10, 20, 30}, 0.5);
  FrameImage image;
  const FrameStats stats = drawn.draw(camera, sized(400, 300, RenderMode::triangles, 16), image);
  EXPECT_GE(stats.triangles, 8192u);
  EXPECT_EQ(stats.impostors, 0u);
  EXPECT_NEAR(coveredPixels(image) / discPixels(2, 12, 0.5, 300), 1, 0.005);
  EXPECT_EQ(alphaAt(image, 200, 150), 255);
  EXPECT_EQ(alphaAt(image, 2, 2), 0);
}

TEST(Renderer, aSphereOfImpostorsCoversItsDisc) {
  DrawnPack drawn = openDrawn(sphereTriangles({10, 20, 30}, 2, 4, kWhite), {.level = 1});
  const Camera camera = lookAt({10 + 30, 20 - 11, 30 + 7}, {10, 20, 30}, 0.3);
  FrameImage image;
  for (const ImpostorKind kind : {ImpostorKind::flat, ImpostorKind::depthCorrected, ImpostorKind::blended}) {
    const FrameStats stats = drawn.draw(camera, sized(400, 300, RenderMode::impostors, 4, kind), image);
    EXPECT_EQ(stats.triangles, 0u);
    EXPECT_GE(stats.impostors, 1u);
    const double expected = discPixels(2, std::sqrt(30. * 30 + 11 * 11 + 7 * 7), 0.3, 300);
    EXPECT_NEAR(coveredPixels(image) / expected, 1, 0.03) << "kind " << static_cast<int>(kind);
    EXPECT_EQ(image.impostorCoverage[150 * 400 + 200], 255);
  }
}

TEST(Renderer, aLitBoxFacingTheCameraHasExactlyTheShadedColour) {
  const uint32_t albedo = 0x00204080;
  DrawnPack drawn =
      openDrawn(boxTriangles({-1, -1, -1}, {1, 1, 1}, albedo), {.level = 1, .views = 12, .samplesPerEdge = 2});
  const glm::vec3 sun = sunDirection(UpAxis::z, Sun{});
  const glm::vec3 expected = shared::shade(glm::vec3(0x80, 0x40, 0x20) / 255.0f, glm::vec3(1, 0, 0), sun) * 255.0f;
  FrameImage image;
  for (const RenderMode mode : {RenderMode::triangles, RenderMode::impostors}) {
    drawn.draw(lookAt({9, 0, 0}, {0, 0, 0}), sized(160, 120, mode), image);
    for (const auto& [x, y] : {std::pair{80, 60}, std::pair{70, 66}, std::pair{89, 55}})
      for (int channel = 0; channel < 3; ++channel)
        EXPECT_NEAR(image.rgba[static_cast<size_t>((y * 160 + x) * 4 + channel)], expected[channel], 1.01)
            << x << ',' << y << " mode " << static_cast<int>(mode);
    EXPECT_EQ(alphaAt(image, 80, 60), 255);
  }
}

TEST(Renderer, impostorsShowWhatTrianglesShow) {
  auto scene = sphereTriangles({0, 0, 0}, 1, 4, 0x0040c0ff);
  for (const auto& triangle : boxTriangles({-2, -2, -1.5}, {2, 2, -1}, 0x0030a040)) scene.push_back(triangle);
  // A texel is a pixel here, twice what the level rule allows.
  DrawnPack drawn = openDrawn(scene, {.level = 2, .imageSize = 64});
  std::mt19937 random(5);
  std::uniform_real_distribution<double> angle(0, 2 * std::numbers::pi);
  for (int i = 0; i < 4; ++i) {
    const double azimuth = angle(random);
    const Camera camera =
        lookAt(16.0 * glm::dvec3(std::cos(azimuth), std::sin(azimuth), 0.3 + 0.2 * i), {0, 0, -0.5}, 0.4);
    SCOPED_TRACE(fmt::format("azimuth {}", azimuth));
    FrameImage triangles, impostors;
    drawn.draw(camera, sized(320, 240, RenderMode::triangles, 16), triangles);
    const FrameStats stats = drawn.draw(camera, sized(320, 240, RenderMode::impostors), impostors);
    EXPECT_GT(stats.impostors, 1u);
    EXPECT_LT(difference(triangles, impostors).mean, 1.5);
    EXPECT_NEAR(coveredPixels(impostors) / coveredPixels(triangles), 1, 0.01);
    drawn.draw(camera, sized(320, 240, RenderMode::impostors, 4, ImpostorKind::flat), impostors);
    EXPECT_LT(difference(triangles, impostors).mean, 6);
  }
}

TEST(Renderer, trianglesModeAndFullModeAreTheSamePicture) {
  DrawnPack drawn = openDrawn(sphereTriangles({0, 0, 0}, 1, 4, kWhite), {.level = 3, .withViews = false});
  FrameImage culled, full;
  const Camera camera = lookAt({0.3, 0.2, 1.4}, {0.9, 0.1, 0.2}, 0.9);
  const FrameStats some = drawn.draw(camera, sized(200, 150, RenderMode::triangles), culled);
  const FrameStats all = drawn.draw(camera, sized(200, 150, RenderMode::full), full);
  EXPECT_LT(some.triangles, all.triangles);
  EXPECT_EQ(all.triangles, drawn.pack->directory().cells[0].triangles);
  EXPECT_EQ(culled.rgba, full.rgba);
  EXPECT_GT(coveredPixels(full), 1000);
}

TEST(Renderer, noCracksOpenBetweenCells) {
  // Large slanted triangles around the eye, cut into many cells: from inside nothing else can be seen.
  const auto scene = sphereTriangles({0.1, 0.2, 0.3}, 5, 1, kWhite);
  DrawnPack drawn = openDrawn(scene, {.level = 4, .withViews = false});
  const unsigned seed = 7;
  SCOPED_TRACE(fmt::format("seed {}", seed));
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> place(-1.5, 1.5);
  for (int i = 0; i < 12; ++i) {
    const Camera camera = lookAt({place(random), place(random), place(random)},
                                 {3 * place(random), 3 * place(random), 3 * place(random)}, 1.2);
    FrameImage image;
    drawn.draw(camera, sized(320, 240, RenderMode::triangles, i % 2 ? 1 : 4), image);
    EXPECT_EQ(coveredPixels(image), 320.0 * 240.0) << "camera " << i;
  }
}

TEST(Renderer, aPictureDoesNotDependOnScaleOrOffset) {
  auto sceneAt = [](glm::dvec3 offset, double scale) {
    auto scene = sphereTriangles({0, 0, 0}, 1, 3, 0x0040c0ff);
    for (const auto& triangle : boxTriangles({-2, -2, -1.5}, {2, 2, -1}, 0x0030a040)) scene.push_back(triangle);
    for (auto& triangle : scene)
      for (auto& corner : triangle.corners) corner = offset + corner * scale;
    return scene;
  };
  FrameImage expected[2], found;
  for (const auto& [offset, scale] : {std::pair{0.0, 1.0}, {1e6, 1.0}, {0.0, 1e-6}, {0.0, 1e6}, {-3e6, 1e-2}}) {
    SCOPED_TRACE(fmt::format("offset {} scale {}", offset, scale));
    const glm::dvec3 shift(offset, -offset, offset / 2);
    DrawnPack drawn = openDrawn(sceneAt(shift, scale), {.level = 2, .views = 12, .imageSize = 32, .samplesPerEdge = 2});
    const Camera camera = lookAt(shift + glm::dvec3(9, 5, 4) * scale, shift, 0.5);
    for (int i = 0; i < 2; ++i) {
      drawn.draw(camera, sized(200, 150, i == 0 ? RenderMode::triangles : RenderMode::impostors), found);
      if (expected[i].rgba.empty()) expected[i] = found;
      EXPECT_LT(difference(expected[i], found).mean, 0.05);
      EXPECT_GT(coveredPixels(found), 3000);
    }
  }
}

TEST(Renderer, aSmallResidencyBudgetChangesNothingButTheBytesRead) {
  const auto scene = sphereTriangles({0, 0, 0}, 1, 4, 0x0040c0ff);
  const SyntheticPack settings{.level = 2, .views = 12, .imageSize = 32, .samplesPerEdge = 1};
  DrawnPack large = openDrawn(scene, settings);
  DrawnPack small = openDrawn(scene, settings, 100'000);
  DrawnPack tiny = openDrawn(scene, settings, 1);
  const Camera camera = lookAt({9, 5, 4}, {0, 0, 0}, 0.35);
  for (const RenderMode mode : {RenderMode::triangles, RenderMode::impostors}) {
    FrameImage a, b, c;
    large.draw(camera, sized(200, 150, mode), a);
    EXPECT_EQ(large.draw(camera, sized(200, 150, mode), a).bytesRead, 0u);
    small.draw(camera, sized(200, 150, mode), b);
    small.draw(camera, sized(200, 150, mode), b);
    tiny.draw(camera, sized(200, 150, mode), c);
    EXPECT_GT(tiny.draw(camera, sized(200, 150, mode), c).bytesRead, 0u);
    EXPECT_EQ(a.rgba, b.rgba);
    EXPECT_EQ(a.rgba, c.rgba);
  }
}

TEST(Renderer, trianglesHideImpostorsBehindAndShowThoseInFront) {
  // A row of boxes along the view: whichever of them are triangles, the nearest box alone is seen.
  std::vector<SyntheticTriangle> scene;
  const std::array<uint32_t, 4> colours = {0x000000ff, 0x0000ff00, 0x00ff0000, 0x00ffffff};
  for (int i = 0; i < 4; ++i)
    for (const auto& triangle : boxTriangles({i * 4.0, -1, -1}, {i * 4.0 + 2, 1, 1}, colours[static_cast<size_t>(i)]))
      scene.push_back(triangle);
  DrawnPack drawn = openDrawn(scene, {.level = 2, .views = 12, .imageSize = 32});
  for (const double side : {-1.0, 1.0}) {
    const Camera camera = lookAt({7 + side * 30, 0.01, 0.02}, {7, 0, 0}, 0.12);
    FrameImage expected, found;
    drawn.draw(camera, sized(160, 120, RenderMode::triangles), expected);
    const uint64_t all = drawn.pack->directory().cells[0].triangles;
    for (const uint64_t budget : {all / 4, all / 2, all * 3 / 4}) {
      RenderSettings settings = sized(160, 120, RenderMode::automatic);
      settings.selection.texelPixels = 1e-6;  // nothing is far enough: the budget decides
      settings.selection.triangleBudget = budget;
      const FrameStats stats = drawn.draw(camera, settings, found);
      EXPECT_GT(stats.impostors, 0u);
      EXPECT_GT(stats.triangles, 0u);
      for (size_t channel = 0; channel < 4; ++channel) {
        const size_t centre = (60 * 160 + 80) * 4 + channel;
        EXPECT_NEAR(found.rgba[centre], expected.rgba[centre], 2) << "side " << side << " budget " << budget;
      }
    }
  }
}

TEST(Renderer, impossibleSettingsAreRefused) {
  DrawnPack drawn = openDrawn(boxTriangles({-1, -1, -1}, {1, 1, 1}, kWhite), {.level = 0, .withViews = false});
  FrameImage image;
  const Camera camera = lookAt({9, 0, 0}, {0, 0, 0});
  for (const RenderSettings& settings :
       {sized(0, 10, RenderMode::full), sized(10, 1 << 20, RenderMode::full), sized(10, 10, RenderMode::full, 3)}) {
    const auto result = drawn.renderer->draw(camera, settings, &image);
    ASSERT_FALSE(result);
    EXPECT_EQ(result.error().kind, ErrorKind::invalidArgument);
  }
}

TEST(Renderer, anEyeAnywhereAndAnyDistanceDrawsWithoutFailing) {
  DrawnPack drawn =
      openDrawn(sphereTriangles({0, 0, 0}, 1, 2, kWhite), {.level = 2, .imageSize = 16, .samplesPerEdge = 1});
  FrameImage image;
  for (const glm::dvec3 eye : {glm::dvec3(0), glm::dvec3(1, 0, 0), glm::dvec3(1e9, 0, 0), glm::dvec3(1e200, 1e200, 0),
                               glm::dvec3(-1e308, 0, 0)})
    for (const RenderMode mode : {RenderMode::automatic, RenderMode::impostors, RenderMode::full})
      for (const ImpostorKind kind : {ImpostorKind::flat, ImpostorKind::depthCorrected, ImpostorKind::blended})
        drawn.draw(lookAt(eye, {0, 0, 0.001}), sized(64, 48, mode, 4, kind), image);
  EXPECT_EQ(image.width, 64);
}

}  // namespace
}  // namespace farcell
