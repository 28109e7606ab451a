// The picture of a sphere's octahedral impostor against the sphere itself.
#include "tools/evaluate/baselines/octahedral.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/evaluate_models.h"

namespace farcell {
namespace {

constexpr int kWidth = 120, kHeight = 90;
const glm::dvec3 kCentre(100, 200, 300);
constexpr double kRadius = 10;

// Of the pixel's centre.
bool hitsSphere(const Camera& camera, int x, int y, double radius) {
  const CameraAxes axes = cameraAxes(camera);
  const double tanY = std::tan(camera.fovYRad / 2), tanX = tanY * kWidth / kHeight;
  const glm::dvec3 ray = glm::normalize(axes.right * ((2 * (x + 0.5) / kWidth - 1) * tanX) +
                                        axes.up * ((1 - 2 * (y + 0.5) / kHeight) * tanY) - axes.back);
  const glm::dvec3 to = kCentre - camera.position;
  return glm::length(to - ray * glm::dot(to, ray)) < radius;
}

TEST(OctahedralImpostor, OfASphereCoversTheSphereFromAnyDirectionAbove) {
  testing::TemporaryDirectory directory;
  testing::writeTestPack(testing::sphereModel(kCentre, kRadius, 4), directory.path() / "s.far", 1);
  const PackFile pack = PackFile::open(directory.path() / "s.far").value();
  GlContext context = GlContext::createHeadless().value();
  const OctahedralViews views = bakeOctahedral(pack, 64, sunDirection(UpAxis::z, Sun{})).value();
  ASSERT_EQ(views.colours.size(), size_t{kOctahedralFrames});
  const OctahedralImpostor impostor = OctahedralImpostor::create(context, views).value();
  for (const glm::dvec3 arm : {glm::dvec3(50, 3, 12), glm::dvec3(-20, -35, 30), glm::dvec3(2, 1, 60)}) {
    const Camera camera{"c", kCentre + arm, kCentre, {0, 0, 1}, 0.6};
    FrameImage image;
    const FrameStats stats = impostor.draw(camera, kWidth, kHeight, &image);
    EXPECT_EQ(stats.impostors, 1u);
    int covered = 0;
    for (int y = 0; y < kHeight; ++y)
      for (int x = 0; x < kWidth; ++x) {
        const uint8_t alpha = image.rgba[4 * static_cast<size_t>(y * kWidth + x) + 3];
        covered += alpha > 127 ? 1 : 0;
        EXPECT_EQ(image.impostorCoverage[static_cast<size_t>(y * kWidth + x)], alpha);
        // A texel is .54 units wide; a frame aslant sees the rim of the sphere as its own, which lies within.
        if (hitsSphere(camera, x, y, kRadius - 2)) {
          EXPECT_GT(alpha, 200) << x << ' ' << y;
        }
        if (!hitsSphere(camera, x, y, kRadius + 0.8)) {
          EXPECT_LT(alpha, 30) << x << ' ' << y;
        }
      }
    EXPECT_GT(covered, 500);
  }
}

TEST(OctahedralImpostor, TakesTheMemoryItIsGiven) {
  const int edge = octahedralEdgeOf(20'000'000);
  EXPECT_LE(octahedralBytes(edge), 20'000'000u);
  EXPECT_GT(octahedralBytes(edge + 1), 20'000'000u);
  EXPECT_EQ(octahedralEdgeOf(0), 16);
  EXPECT_EQ(octahedralEdgeOf(UINT64_MAX), 1024);
}

}  // namespace
}  // namespace farcell
