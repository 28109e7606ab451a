// Impostors of kind B beside those of kind A: how near to the triangles, and how steady while the eye moves.
#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "tests/runtime/renderer_fixture.h"

namespace farcell {
namespace {

constexpr int kWidth = 200, kHeight = 150;
constexpr double kDistance = 14;

const Viewpoints& viewpoints() {
  static const Viewpoints set = *Viewpoints::create(42);
  return set;
}

// A box behind a sphere: surfaces that curve, that are flat, and that hide each other. Its middle is the origin.
std::vector<SyntheticTriangle> scene() {
  auto triangles = sphereTriangles({0.8, 0.3, 0.5}, 1, 4, 0x0040c0ff);
  for (const auto& triangle : boxTriangles({-1.8, -1.5, -1.5}, {-0.4, 1.5, 1.2}, 0x0030a040))
    triangles.push_back(triangle);
  for (const auto& triangle : boxTriangles({1.2, -1.5, -1.5}, {1.8, 0.2, 1.5}, 0x00c05030))
    triangles.push_back(triangle);
  return triangles;
}

FrameImage drawnFrom(DrawnPack& drawn, glm::dvec3 direction, const RenderSettings& settings) {
  FrameImage image;
  drawn.draw(lookAt(glm::normalize(direction) * kDistance, {0, 0, 0}, 0.35), settings, image);
  return image;
}
FrameImage impostorFrom(DrawnPack& drawn, glm::dvec3 direction, ImpostorKind kind) {
  return drawnFrom(drawn, direction, sized(kWidth, kHeight, RenderMode::impostors, 4, kind));
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

TEST(BlendedImpostors, areAtLeastAsNearToTheTrianglesAsKindA) {
  DrawnPack drawn = openDrawn(scene(), {.level = 0});
  double errorA = 0, errorB = 0;
  for (const glm::dvec3 direction : someDirections(8)) {
    const FrameImage truth = drawnFrom(drawn, direction, sized(kWidth, kHeight, RenderMode::triangles, 16));
    const FrameImage a = impostorFrom(drawn, direction, ImpostorKind::depthCorrected);
    const FrameImage b = impostorFrom(drawn, direction, ImpostorKind::blended);
    errorA += difference(truth, a).mean;
    errorB += difference(truth, b).mean;
    EXPECT_NEAR(coveredPixels(b) / coveredPixels(truth), 1, 0.02);
    for (size_t i = 3; i < truth.rgba.size(); i += 4)
      ASSERT_FALSE(truth.rgba[i] == 255 && b.rgba[i] == 0) << "a hole at byte " << i;
  }
  EXPECT_LE(errorB, errorA);
  EXPECT_GT(errorB, 0);
}

TEST(BlendedImpostors, doNotChangeWhereTheNextThreeViewsTakeOver) {
  DrawnPack drawn = openDrawn(scene(), {.level = 0});
  for (const glm::dvec3 direction : someDirections(6)) {
    const auto triple = viewpoints().nearestThree(direction);
    const glm::dvec3 a = viewpoints().directions()[triple.views[0]], b = viewpoints().directions()[triple.views[1]];
    const glm::dvec3 onEdge = glm::normalize(0.7 * a + 0.3 * b);
    const glm::dvec3 across = glm::normalize(glm::cross(a, b)) * 1e-5;
    ASSERT_NE(viewpoints().nearestThree(onEdge + across).views[2], viewpoints().nearestThree(onEdge - across).views[2]);
    const FrameImage before = impostorFrom(drawn, onEdge + across, ImpostorKind::blended);
    const FrameImage after = impostorFrom(drawn, onEdge - across, ImpostorKind::blended);
    EXPECT_LT(difference(before, after).mean, 0.02);
    EXPECT_LE(difference(before, after).worst, 64) << "rays that graze may change what they meet, a quarter of a pixel";
  }
}

TEST(BlendedImpostors, changeLessThanKindAWhereAnotherViewBecomesTheNearest) {
  DrawnPack drawn = openDrawn(scene(), {.level = 0});
  constexpr double kHalfStepRad = 0.25 * std::numbers::pi / 180;
  double changeA = 0, changeB = 0;
  for (const glm::dvec3 direction : someDirections(6)) {
    const auto triple = viewpoints().nearestThree(direction);
    const auto directions = viewpoints().directions();
    const glm::dvec3 a = directions[triple.views[0]], b = directions[triple.views[1]], c = directions[triple.views[2]];
    const glm::dvec3 between = glm::normalize(0.4 * (a + b) + 0.2 * c), across = glm::normalize(a - b) * kHalfStepRad;
    const auto change = [&](ImpostorKind kind) {
      return difference(impostorFrom(drawn, between + across, kind), impostorFrom(drawn, between - across, kind)).mean;
    };
    changeA += change(ImpostorKind::depthCorrected);
    changeB += change(ImpostorKind::blended);
  }
  EXPECT_LT(changeB, changeA);
}

TEST(BlendedImpostors, drawWithoutHolesWhatThePackHasOfTheThree) {
  const glm::dvec3 direction = someDirections(8)[5];
  const auto triple = viewpoints().nearestThree(direction);
  DrawnPack whole = openDrawn(scene(), {.level = 0});
  const FrameImage expected = impostorFrom(whole, direction, ImpostorKind::blended);
  for (const int missing : triple.views) {
    DrawnPack drawn = openDrawn(scene(), {.level = 0, .leftOut = {missing}});
    const FrameImage found = impostorFrom(drawn, direction, ImpostorKind::blended);
    EXPECT_NE(found.rgba, expected.rgba);
    EXPECT_NEAR(coveredPixels(found) / coveredPixels(expected), 1, 0.02);
    for (size_t i = 3; i < expected.rgba.size(); i += 4)
      ASSERT_FALSE(expected.rgba[i] == 255 && found.rgba[i] < 128) << "view " << missing << ": a hole at byte " << i;
  }
}

}  // namespace
}  // namespace farcell
