// Simplified meshes of inner cells, of packs as the build makes them.
#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <random>

#include "cache/base/file.h"
#include "tests/runtime/built_pack.h"

namespace farcell {
namespace {

// A sphere of 8 * 4^subdivisions triangles around the origin, in leaves of a few hundred.
DrawnPack builtSphere(double radius, int subdivisions, uint64_t residentBytes = kPlentyBytes) {
  std::string text = "OFF\n";
  const auto triangles = sphereTriangles({0, 0, 0}, radius, subdivisions, 0);
  text += fmt::format("{} {} 0\n", 3 * triangles.size(), triangles.size());
  for (const SyntheticTriangle& triangle : triangles)
    for (const glm::dvec3& p : triangle.corners) text += fmt::format("{:.17g} {:.17g} {:.17g}\n", p.x, p.y, p.z);
  for (size_t i = 0; i < triangles.size(); ++i) text += fmt::format("3 {} {} {}\n", 3 * i, 3 * i + 1, 3 * i + 2);
  return buildDrawn(
      "sphere.off", [&](const std::filesystem::path& mesh) { return writeTextFile(mesh, text); }, residentBytes);
}

RenderSettings meshes(double meshPixels, int samples = 4) {
  RenderSettings settings = sized(240, 180, RenderMode::meshes, samples);
  settings.selection.meshPixels = meshPixels;
  return settings;
}

TEST(Meshes, ofTinyErrorAreTheFullPictureAndOfMoreAreFewerTriangles) {
  DrawnPack drawn = builtSphere(3, 6);
  const Camera camera = lookAt({9, 4, 3}, {0, 0, 0}, 0.6);
  FrameImage full, found;
  const uint64_t all = drawn.draw(camera, sized(240, 180, RenderMode::full), full).triangles;
  const FrameStats tiny = drawn.draw(camera, meshes(1e-6), found);
  EXPECT_EQ(tiny.triangles, all);
  EXPECT_EQ(tiny.meshes, 0u);
  EXPECT_EQ(found.rgba, full.rgba);
  uint64_t last = all;
  for (const double pixels : {0.6, 5.0}) {
    const FrameStats stats = drawn.draw(camera, meshes(pixels), found);
    EXPECT_GT(stats.meshes, 0u) << pixels;
    EXPECT_LT(stats.triangles, last) << pixels;
    last = stats.triangles;
    // The silhouette moves by no more than the error: a band around a disc of this radius.
    const double radiusPx = 90 * 3 / std::sqrt(106 - 9.0) / std::tan(0.3);
    EXPECT_NEAR(coveredPixels(found), coveredPixels(full), 2 * 3.1416 * radiusPx * pixels + 10) << pixels;
  }
  EXPECT_LT(last, all / 5);
}

TEST(Meshes, ofManyLevelsMeetWithoutACrack) {
  // From inside, near one side: what is near is drawn in full, what is far from coarse cells; no background is seen.
  DrawnPack drawn = builtSphere(3, 6);
  const unsigned seed = 3;
  SCOPED_TRACE(fmt::format("seed {}", seed));
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> place(-1, 1);
  for (int i = 0; i < 12; ++i) {
    const glm::dvec3 direction = glm::normalize(glm::dvec3(place(random), place(random), place(random)));
    const Camera camera = lookAt(direction * 2.8, {place(random), place(random), place(random)}, 1.5);
    RenderSettings settings = meshes(1 + i % 3, i % 2 ? 1 : 4);
    FrameImage image;
    settings.show = Show::levels;
    const FrameStats levels = drawn.draw(camera, settings, image);
    EXPECT_GE(levels.legend.size(), 2u) << "camera " << i;
    settings.show = Show::picture;
    EXPECT_GT(drawn.draw(camera, settings, image).meshes, 0u);
    EXPECT_EQ(coveredPixels(image), 240.0 * 180.0) << "camera " << i;
  }
}

TEST(Meshes, aSmallResidencyBudgetChangesNothingButTheBytesRead) {
  DrawnPack large = builtSphere(3, 5), tiny = builtSphere(3, 5, 1);
  const Camera camera = lookAt({4, 2, 1}, {0, 0, 0}, 0.9);
  FrameImage a, b;
  EXPECT_GT(large.draw(camera, meshes(4), a).meshes, 0u);
  EXPECT_EQ(large.draw(camera, meshes(4), a).bytesRead, 0u);
  tiny.draw(camera, meshes(4), b);
  EXPECT_GT(tiny.draw(camera, meshes(4), b).bytesRead, 0u);
  EXPECT_EQ(a.rgba, b.rgba);
}

TEST(Meshes, automaticPicturesDrawThemWithinTheBudgetAndShowThem) {
  DrawnPack drawn = builtSphere(3, 6);
  const Camera camera = lookAt({3.5, 1.5, 1}, {0, 0, 0}, 0.9);
  RenderSettings settings = sized(240, 180, RenderMode::automatic);
  settings.selection.texelPixels = 1e-6;  // none is far enough
  settings.selection.meshPixels = 8;
  settings.show = Show::kinds;
  FrameImage image;
  const uint64_t budget = 3000;
  settings.selection.triangleBudget = budget;
  const FrameStats stats = drawn.draw(camera, settings, image);
  EXPECT_LE(stats.triangles, budget);
  EXPECT_GT(stats.meshes, 0u);
  ASSERT_EQ(stats.legend.size(), 3u);
  EXPECT_EQ(stats.legend[1].meaning, "simplified mesh");
  const auto& colour = stats.legend[1].colour;
  size_t pixels = 0;  // of the hue of meshes: the channels' order and no grey
  for (size_t i = 0; i < image.rgba.size(); i += 4) {
    const double scale = image.rgba[i + 2] / static_cast<double>(colour[2]);
    pixels += image.rgba[i + 3] == 255 && std::abs(image.rgba[i] - scale * colour[0]) < 3 &&
              std::abs(image.rgba[i + 1] - scale * colour[1]) < 3;
  }
  EXPECT_GT(pixels, 1000u);
}

}  // namespace
}  // namespace farcell
