// Impostors of kind B beside those of kind A: how near to the triangles, and how steady while the eye moves.
#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "tests/runtime/renderer_fixture.h"

namespace farcell {
namespace {

constexpr int kWidth = 100, kHeight = 75;  // texels are two thirds of a pixel
constexpr double kDistance = 14;

const Viewpoints& viewpoints() {
  static const Viewpoints set = *Viewpoints::create(42);
  return set;
}

// A sphere sunk into a box: surfaces that curve, that are flat, and an edge where they meet; hardly a place that
// neighbouring views cannot see. The middle of the content is the origin.
std::vector<SyntheticTriangle> scene() {
  auto triangles = sphereTriangles({0, 0, 0.3}, 1, 4, 0x0040c0ff);
  for (const auto& triangle : boxTriangles({-1.6, -1.6, -1.3}, {1.6, 1.6, -0.3}, 0x0030a040))
    triangles.push_back(triangle);
  return triangles;
}

FrameImage drawnFrom(DrawnPack& drawn, glm::dvec3 direction, const RenderSettings& settings) {
  FrameImage image;
  drawn.draw(lookAt(glm::normalize(direction) * kDistance, {0, 0, 0}, 0.35), settings, image);
  return image;
}
FrameImage impostorFrom(DrawnPack& drawn, glm::dvec3 direction, ImpostorKind kind, bool handOver = false) {
  RenderSettings settings = sized(kWidth, kHeight, RenderMode::impostors, 4, kind);
  settings.handOver = handOver;
  return drawnFrom(drawn, direction, settings);
}

// Directions between views, spread over the sphere (Fibonacci).
std::vector<glm::dvec3> someDirections(int count) {
  std::vector<glm::dvec3> result;
  for (int i = 0; i < count; ++i) {
    const double height = 0.9 * (2 * (i + 0.5) / count - 1), around = std::sqrt(1 - height * height);
    result.emplace_back(around * std::cos(2.399963 * i), around * std::sin(2.399963 * i), height);
  }
  return result;
}

// Pixels that the truth covers and the picture leaves open by half or more.
int holes(const FrameImage& truth, const FrameImage& image) {
  int count = 0;
  for (size_t i = 3; i < truth.rgba.size(); i += 4) count += truth.rgba[i] == 255 && image.rgba[i] < 128;
  return count;
}

TEST(BlendedImpostors, haveFewerHolesThanKindAAndHardlyMoreError) {
  DrawnPack drawn = openDrawn(scene(), {.level = 0, .imageSize = 128});
  double errorA = 0, errorB = 0;
  int holesA = 0, holesB = 0;
  for (const glm::dvec3 direction : someDirections(8)) {
    const FrameImage truth = drawnFrom(drawn, direction, sized(kWidth, kHeight, RenderMode::triangles, 16));
    const FrameImage a = impostorFrom(drawn, direction, ImpostorKind::depthCorrected);
    const FrameImage b = impostorFrom(drawn, direction, ImpostorKind::blended);
    errorA += difference(truth, a).mean;
    errorB += difference(truth, b).mean;
    const double coverageA = coveredPixels(a) / coveredPixels(truth),
                 coverageB = coveredPixels(b) / coveredPixels(truth);
    EXPECT_LE(std::abs(coverageB - 1), std::abs(coverageA - 1) + 0.01);
    holesA += holes(truth, a);
    holesB += holes(truth, b);
  }
  EXPECT_LE(errorB, errorA * 1.1);
  EXPECT_LE(holesB, holesA);
  EXPECT_GT(errorB, 0);
}

TEST(BlendedImpostors, doNotChangeWhereTheNextThreeViewsTakeOver) {
  DrawnPack drawn = openDrawn(scene(), {.level = 0, .imageSize = 128});
  for (const glm::dvec3 direction : someDirections(6)) {
    const auto triple = viewpoints().nearestThree(direction);
    const glm::dvec3 a = viewpoints().directions()[triple.views[0]], b = viewpoints().directions()[triple.views[1]];
    const glm::dvec3 onEdge = glm::normalize(0.7 * a + 0.3 * b);
    const glm::dvec3 across = glm::normalize(glm::cross(a, b)) * 1e-5;
    ASSERT_NE(viewpoints().nearestThree(onEdge + across).views[2], viewpoints().nearestThree(onEdge - across).views[2]);
    const FrameImage before = impostorFrom(drawn, onEdge + across, ImpostorKind::blended);
    const FrameImage after = impostorFrom(drawn, onEdge - across, ImpostorKind::blended);
    EXPECT_LT(difference(before, after).mean, 0.03);
    EXPECT_LE(difference(before, after).worst, 64) << "rays that graze may change what they meet, a quarter of a pixel";
  }
}

TEST(BlendedImpostors, andHandOverChangeLessThanKindAWhereAnotherViewBecomesTheNearest) {
  DrawnPack drawn = openDrawn(scene(), {.level = 0, .imageSize = 128});
  constexpr double kHalfStepRad = 0.25 * std::numbers::pi / 180;
  double changeA = 0, changeB = 0, handedOver = 0;
  for (const glm::dvec3 direction : someDirections(6)) {
    const auto triple = viewpoints().nearestThree(direction);
    const auto directions = viewpoints().directions();
    const glm::dvec3 a = directions[triple.views[0]], b = directions[triple.views[1]], c = directions[triple.views[2]];
    const glm::dvec3 between = glm::normalize(0.4 * (a + b) + 0.2 * c), across = glm::normalize(a - b) * kHalfStepRad;
    const auto change = [&](ImpostorKind kind, bool handOver = false) {
      return difference(impostorFrom(drawn, between + across, kind, handOver),
                        impostorFrom(drawn, between - across, kind, handOver))
          .mean;
    };
    handedOver += change(ImpostorKind::depthCorrected, true);
    changeA += change(ImpostorKind::depthCorrected);
    changeB += change(ImpostorKind::blended);
  }
  EXPECT_LT(changeB, changeA);
  EXPECT_LT(handedOver, 0.95 * changeA);
}

TEST(BlendedImpostors, drawWithoutHolesWhatThePackHasOfTheThree) {
  const glm::dvec3 direction = someDirections(8)[5];
  const auto triple = viewpoints().nearestThree(direction);
  DrawnPack whole = openDrawn(scene(), {.level = 0, .imageSize = 128});
  const FrameImage expected = impostorFrom(whole, direction, ImpostorKind::blended);
  for (const int missing : triple.views) {
    DrawnPack drawn = openDrawn(scene(), {.level = 0, .imageSize = 128, .leftOut = {missing}});
    const FrameImage found = impostorFrom(drawn, direction, ImpostorKind::blended);
    EXPECT_NE(found.rgba, expected.rgba);
    EXPECT_NEAR(coveredPixels(found) / coveredPixels(expected), 1, 0.02);
    EXPECT_EQ(holes(expected, found), 0) << "view " << missing;
  }
}

}  // namespace
}  // namespace farcell
