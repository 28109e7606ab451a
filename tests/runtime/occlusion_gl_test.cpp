// Pictures with and without what nearer triangles hide, of a small procedural city as the build makes it.
#include <gtest/gtest.h>

#include <random>

#include "datasets/city/city.h"
#include "tests/runtime/built_pack.h"

namespace farcell {
namespace {

DrawnPack builtCity(uint64_t triangles) {
  return buildDrawn("city.ply", [&](const std::filesystem::path& mesh) -> Result<> {
    Progress silent(false);
    FARCELL_TRY(writeCity({.triangles = triangles, .seed = 2}, mesh, silent));
    return {};
  });
}

// Low over the ground, somewhere, looking about; every fourth from above.
Camera randomCamera(const Model& model, std::mt19937& random, int index) {
  std::uniform_real_distribution<double> part(0, 1);
  const glm::dvec3 min = model.grid.worldFromGrid(model.bounds.min), max = model.grid.worldFromGrid(model.bounds.max);
  const glm::dvec3 size = max - min;
  const double height = index % 4 == 0 ? 60 : 1.5 + 8 * part(random);
  const glm::dvec3 eye(min.x + size.x * (0.2 + 0.6 * part(random)), min.y + size.y * (0.2 + 0.6 * part(random)),
                       min.z + height);
  const double azimuth = 6.283 * part(random);
  const double slope = index % 4 == 0 ? -0.3 : 0.2 * (part(random) - 0.5);
  return lookAt(eye, eye + glm::dvec3(std::cos(azimuth), std::sin(azimuth), slope), 0.9);
}

TEST(Occlusion, changesNoPixelOfACity) {
  DrawnPack drawn = builtCity(60'000);
  const unsigned seed = 6;
  std::mt19937 random(seed);
  uint64_t hidden = 0, hiddenTriangles = 0;
  for (int i = 0; i < 32; ++i) {
    SCOPED_TRACE(fmt::format("seed {}, camera {}", seed, i));
    const Camera camera = randomCamera(drawn.pack->directory().model, random, i);
    const RenderMode mode = i % 3 == 0   ? RenderMode::automatic
                            : i % 3 == 1 ? RenderMode::meshes
                                         : RenderMode::triangles;
    RenderSettings settings = sized(320, 180, mode, i % 2 == 0 ? 4 : i % 8 == 1 ? 16 : 1);
    settings.selection.triangleBudget = 1'000'000'000;
    settings.occlusionMustPay = false;
    FrameImage without, with;
    settings.occlusion = false;
    const FrameStats all = drawn.draw(camera, settings, without);
    EXPECT_EQ(all.hiddenCells, 0u);
    settings.occlusion = true;
    const FrameStats stats = drawn.draw(camera, settings, with);
    EXPECT_LE(stats.triangles, all.triangles);
    hidden += stats.hiddenCells;
    hiddenTriangles += all.triangles - stats.triangles;
    ASSERT_EQ(with.rgba, without.rgba);
  }
  EXPECT_GT(hidden, 20u);
  EXPECT_GT(hiddenTriangles, 2'000u);
}

TEST(Occlusion, hiddenCellsAreNotRead) {
  DrawnPack drawn = builtCity(60'000);
  std::mt19937 random(6);
  uint64_t with = 0, without = 0;
  for (int i = 0; i < 8; ++i) {
    const Camera camera = randomCamera(drawn.pack->directory().model, random, i);
    for (const bool occlusion : {false, true}) {
      auto renderer = Renderer::create(sharedContext(), *drawn.pack, kPlentyBytes);
      ASSERT_TRUE(renderer);
      RenderSettings settings = sized(320, 180, RenderMode::triangles, 1);
      settings.occlusion = occlusion;
      settings.occlusionMustPay = false;
      const auto stats = renderer->draw(camera, settings, nullptr);
      ASSERT_TRUE(stats) << stats.error().message;
      (occlusion ? with : without) += stats->bytesRead - stats->occlusionBytes;
    }
  }
  EXPECT_LT(with, without);
}

}  // namespace
}  // namespace farcell
