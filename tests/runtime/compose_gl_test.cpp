// How cells are put together: over each other, over triangles, over whatever lies behind; and while they are handed
// over from one way of drawing them to the next.
#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "shaders/shared/shading.h"
#include "tests/runtime/renderer_fixture.h"

namespace farcell {
namespace {

constexpr int kWidth = 200, kHeight = 150;
constexpr uint32_t kRed = 0x000000ff, kGreen = 0x0000ff00, kBlue = 0x00ff0000;

using Triangles = std::vector<SyntheticTriangle>;

void append(Triangles& to, const Triangles& more) { to.insert(to.end(), more.begin(), more.end()); }

// In a plane of constant x.
Triangles disc(double x, double radius, uint32_t colour) {
  Triangles result;
  constexpr int kParts = 64;
  const auto rim = [&](int i) {
    const double angle = 2 * std::numbers::pi * i / kParts;
    return glm::dvec3(x, radius * std::cos(angle), radius * std::sin(angle));
  };
  for (int i = 0; i < kParts; ++i) result.push_back({{glm::dvec3(x, 0, 0), rim(i), rim(i + 1)}, colour});
  return result;
}

Triangles rectangle(double x, glm::dvec2 low, glm::dvec2 high, uint32_t colour) {
  const glm::dvec3 a(x, low.x, low.y), b(x, high.x, low.y), c(x, high.x, high.y), d(x, low.x, high.y);
  return {{{a, b, c}, colour}, {{a, c, d}, colour}};
}

// Half of a square is covered, by stripes finer than samples.
Triangles stripes(double x, double half, uint32_t colour) {
  constexpr int kStripes = 240;
  Triangles result;
  for (int i = 0; i < kStripes; ++i) {
    const double low = -half + 2 * half * i / kStripes;
    append(result, rectangle(x, {low, -half}, {low + half / kStripes, half}, colour));
  }
  return result;
}

// Of a surface that faces along x, 0..255.
double litFacingX() { return 255 * shared::lightFactor(glm::vec3(1, 0, 0), sunDirection(UpAxis::z, Sun{})); }

int channelAt(const FrameImage& image, int x, int y, int channel) {
  return image.rgba[static_cast<size_t>((y * image.width + x) * 4 + channel)];
}

FrameImage picture(DrawnPack& drawn, const Camera& camera, const RenderSettings& settings) {
  FrameImage image;
  drawn.draw(camera, settings, image);
  return image;
}

TEST(Compose, aDiscOfOneColourHasThatColourUpToItsEdge) {
  DrawnPack drawn = openDrawn(disc(0.2, 1, kRed), {.level = 1});
  for (const ImpostorKind kind : {ImpostorKind::flat, ImpostorKind::depthCorrected, ImpostorKind::blended})
    for (const int samples : {1, 4, 16}) {
      SCOPED_TRACE(fmt::format("kind {} samples {}", static_cast<int>(kind), samples));
      const Camera camera = lookAt({9, 1.1, 0.7}, {0.2, 0, 0}, 0.45);
      const FrameImage image = picture(drawn, camera, sized(kWidth, kHeight, RenderMode::impostors, samples, kind));
      int edges = 0;
      for (int y = 0; y < kHeight; ++y)
        for (int x = 0; x < kWidth; ++x) {
          const int alpha = alphaAt(image, x, y);
          edges += alpha > 20 && alpha < 235;
          EXPECT_NEAR(channelAt(image, x, y, 0), alpha * litFacingX() / 255, 2.1) << x << ',' << y;
          EXPECT_EQ(channelAt(image, x, y, 1), 0);
        }
      EXPECT_GT(edges, 50);
    }
}

TEST(Compose, aDiscCoversItsArea) {
  DrawnPack drawn = openDrawn(disc(0.2, 1, kRed), {.level = 1});
  for (const glm::dvec3 eye : {glm::dvec3(9, 1.1, 0.7), glm::dvec3(7, 5, 3), glm::dvec3(-8, 3, 1)}) {
    SCOPED_TRACE(fmt::format("eye {} {} {}", eye.x, eye.y, eye.z));
    const Camera camera = lookAt(eye, {0.2, 0, 0}, 0.45);
    const double truth = coveredPixels(picture(drawn, camera, sized(kWidth, kHeight, RenderMode::triangles, 16)));
    for (const ImpostorKind kind : {ImpostorKind::depthCorrected, ImpostorKind::blended}) {
      const auto image = picture(drawn, camera, sized(kWidth, kHeight, RenderMode::impostors, 4, kind));
      EXPECT_NEAR(coveredPixels(image) / truth, 1, 0.02) << "kind " << static_cast<int>(kind);
    }
  }
}

TEST(Compose, whatIsBehindAnEdgeShinesThroughByWhatTheEdgeLeavesOpen) {
  Triangles scene = disc(3, 0.7, kRed);
  append(scene, rectangle(-3, {-3, -3}, {3, 3}, kGreen));
  DrawnPack drawn = openDrawn(scene, {.level = 1});
  const Camera camera = lookAt({14, 1.1, 0.7}, {0, 0, 0}, 0.14);  // the green one fills the picture
  RenderSettings mixed = sized(kWidth, kHeight, RenderMode::automatic);
  mixed.selection.texelPixels = 1e-6;  // nothing is far enough: the budget decides
  for (const uint64_t budget : {0, 2, 80}) {
    mixed.selection.triangleBudget = budget;
    const FrameImage image = picture(drawn, camera, mixed);
    int edges = 0;
    for (int y = 0; y < kHeight; ++y)
      for (int x = 0; x < kWidth; ++x) {
        const double red = channelAt(image, x, y, 0) / litFacingX(), green = channelAt(image, x, y, 1) / litFacingX();
        EXPECT_NEAR(red + green, 1, 0.03) << x << ',' << y << " budget " << budget;
        EXPECT_GE(alphaAt(image, x, y), 248);
        edges += red > 0.1 && green > 0.1;
      }
    EXPECT_GT(edges, 50);
  }
}

TEST(Compose, halfCoveringLayersEachTakeHalfOfWhatTheOnesBeforeLeave) {
  Triangles scene = stripes(3, 1, kRed);
  append(scene, stripes(1, 1, kGreen));
  append(scene, stripes(-1, 1, kBlue));
  DrawnPack drawn = openDrawn(scene, {.level = 2, .imageSize = 32, .samplesPerEdge = 5});
  for (const ImpostorKind kind : {ImpostorKind::depthCorrected, ImpostorKind::blended}) {
    const FrameImage image =
        picture(drawn, lookAt({30, 0.4, 0.3}, {0, 0, 0}, 0.06), sized(kWidth, kHeight, RenderMode::impostors, 4, kind));
    std::array<double, 4> sums{};
    int count = 0;
    for (int y = kHeight / 2 - 20; y < kHeight / 2 + 20; ++y)
      for (int x = kWidth / 2 - 20; x < kWidth / 2 + 20; ++x, ++count)
        for (int channel = 0; channel < 4; ++channel)
          sums[static_cast<size_t>(channel)] += channelAt(image, x, y, channel);
    for (size_t i = 0; i < 3; ++i)
      EXPECT_NEAR(sums[i] / count / litFacingX(), std::exp2(-1.0 - static_cast<double>(i)), 0.03);
    EXPECT_NEAR(sums[3] / count / 255, 0.875, 0.03);
  }
}

TEST(Compose, aThinWallCoversWhatItsTrianglesCover) {
  DrawnPack drawn = openDrawn(boxTriangles({-2, -0.02, -1}, {2, 0.02, 1}, kGreen), {.level = 1});
  for (const double azimuth : {0.5, 1.2}) {
    const Camera camera = lookAt(16.0 * glm::dvec3(std::cos(azimuth), std::sin(azimuth), 0.2), {0, 0, 0}, 0.3);
    const double truth = coveredPixels(picture(drawn, camera, sized(kWidth, kHeight, RenderMode::triangles, 16)));
    const double found = coveredPixels(picture(drawn, camera, sized(kWidth, kHeight, RenderMode::impostors)));
    EXPECT_NEAR(found / truth, 1, 0.06) << "azimuth " << azimuth;
  }
}

// Pixels within the outline of a sphere that is seen from far.
bool inside(int x, int y, double radiusPixels) {
  return std::hypot(x + 0.5 - kWidth / 2, y + 0.5 - kHeight / 2) < radiusPixels;
}

TEST(Compose, whileCellsAreHandedOverNothingIsSeenThroughThemOrTwice) {
  DrawnPack drawn = openDrawn(sphereTriangles({0, 0, 0}, 1, 4, 0x00ffffff), {.level = 2, .imageSize = 32});
  RenderSettings settings = sized(kWidth, kHeight, RenderMode::automatic);
  int fading = 0;
  for (int i = 0; i < 24; ++i) {
    const double distance = 4 * std::exp2(0.125 * i), fovYRad = 0.8;
    const Camera camera = lookAt(glm::dvec3(0.8, 0.5, std::sqrt(0.11)) * distance, {0, 0, 0}, fovYRad);
    settings.handOver = false;
    const FrameImage plain = picture(drawn, camera, settings);
    settings.handOver = true;
    const FrameImage image = picture(drawn, camera, settings);
    fading += image.rgba != plain.rgba;
    const double radius = kHeight / (2 * std::tan(fovYRad / 2)) / std::sqrt(distance * distance - 1);
    EXPECT_NEAR(coveredPixels(image) / (std::numbers::pi * radius * radius), 1, 0.05) << "distance " << distance;
    for (int y = 0; y < kHeight; ++y)
      for (int x = 0; x < kWidth; ++x)
        if (inside(x, y, radius - 2)) {
          ASSERT_GE(alphaAt(image, x, y), 248) << x << ',' << y << " distance " << distance;
        }
  }
  EXPECT_GT(fading, 2);
}

}  // namespace
}  // namespace farcell
