#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <set>

#include "tools/evaluate/plan/auto_cameras.h"
#include "tools/evaluate/plan/renderers.h"

namespace farcell {
namespace {

TEST(RendererPlan, FullGeometryAtOneAndFourSamplesIsAlwaysThere) {
  const auto plans = planRenderers("A", 640, 480, {.triangleBudget = 1234});
  ASSERT_TRUE(plans) << plans.error().message;
  ASSERT_EQ(plans->size(), 3u);
  EXPECT_EQ((*plans)[0].name, "full-1spp");
  EXPECT_EQ((*plans)[0].settings.samplesPerPixel, 1);
  EXPECT_EQ((*plans)[0].settings.selection.mode, RenderMode::full);
  EXPECT_EQ((*plans)[1].name, "full-4spp");
  EXPECT_EQ((*plans)[1].settings.samplesPerPixel, 4);
  EXPECT_EQ((*plans)[2].name, "A");
  EXPECT_EQ((*plans)[2].settings.width, 640);
  EXPECT_EQ((*plans)[2].settings.height, 480);
}

TEST(RendererPlan, EveryNameHasItsClassModeAndKind) {
  const auto plans = planRenderers(kAllRenderers, 10, 10, {.triangleBudget = 777});
  ASSERT_TRUE(plans) << plans.error().message;
  std::string line;
  for (const RendererPlan& plan : *plans) line += plan.name + ":" + plan.rendererClass + " ";
  EXPECT_EQ(line,
            "full-1spp:geometry full-4spp:geometry full-16spp:geometry triangles:geometry lod:geometry "
            "flat:impostor A:impostor B:impostor auto:mixed auto-B:mixed ");
  EXPECT_EQ((*plans)[2].settings.samplesPerPixel, 16);
  EXPECT_EQ((*plans)[3].settings.selection.mode, RenderMode::triangles);
  EXPECT_EQ((*plans)[4].settings.selection.mode, RenderMode::meshes);
  EXPECT_EQ((*plans)[4].settings.selection.meshPixels, kLodPixels);
  EXPECT_EQ((*plans)[5].settings.kind, ImpostorKind::flat);
  EXPECT_EQ((*plans)[5].settings.selection.mode, RenderMode::impostors);
  EXPECT_EQ((*plans)[6].settings.kind, ImpostorKind::depthCorrected);
  EXPECT_EQ((*plans)[7].settings.kind, ImpostorKind::blended);
  EXPECT_EQ((*plans)[8].settings.selection.mode, RenderMode::automatic);
  EXPECT_EQ((*plans)[8].settings.kind, ImpostorKind::depthCorrected);
  EXPECT_EQ((*plans)[8].settings.selection.triangleBudget, 777u);
  EXPECT_EQ((*plans)[8].settings.selection.meshPixels, kMeshPixels);
  EXPECT_EQ((*plans)[9].settings.kind, ImpostorKind::blended);
}

TEST(RendererPlan, RenderersOfOtherPacksAreNamedAfterThem) {
  const std::vector<std::string> packs = {"paper", "small.far"};
  const auto plans = planRenderers("lod@paper,auto,flat@small.far,flat@paper,A@paper", 10, 10, {}, 2, packs);
  ASSERT_TRUE(plans) << plans.error().message;
  std::string line;
  for (const RendererPlan& plan : *plans) line += plan.name + ":" + plan.pack + " ";
  EXPECT_EQ(line,
            "full-1spp: full-4spp: auto: lod@paper:paper flat@paper:paper A@paper:paper flat@small.far:small.far ");
  EXPECT_EQ((*plans)[3].kind, "lod@paper");
  EXPECT_EQ((*plans)[3].settings.selection.meshPixels, 2);
  EXPECT_EQ((*plans)[4].settings.kind, ImpostorKind::flat);
  for (const char* wrong : {"flat@absent", "flat@", "@paper", "flat@paper@paper", "lod-as-auto@paper,auto"}) {
    const auto result = planRenderers(wrong, 10, 10, {}, 2, packs);
    ASSERT_FALSE(result) << wrong;
    EXPECT_EQ(result.error().kind, ErrorKind::invalidArgument);
  }
}

TEST(RendererPlan, LodAsAutoNeedsAuto) {
  const auto plans = planRenderers("lod-as-auto,auto,lod", 10, 10, {});
  ASSERT_TRUE(plans) << plans.error().message;
  ASSERT_EQ(plans->size(), 5u);
  EXPECT_EQ(plans->back().name, kLodAsAuto) << "after auto, whose time it takes";
  EXPECT_EQ(plans->back().timeOf, "auto");
  EXPECT_EQ(plans->back().settings.selection.mode, RenderMode::meshes);
  EXPECT_EQ((*plans)[3].timeOf, "");
  const auto wrong = planRenderers("lod-as-auto,auto-B", 10, 10, {});
  ASSERT_FALSE(wrong);
  EXPECT_NE(wrong.error().message.find("needs auto"), std::string::npos);
}

TEST(RendererPlan, RepetitionsCountOnceAndWrongNamesAreNamed) {
  const auto twice = planRenderers("auto,auto,full-1spp", 10, 10, {});
  ASSERT_TRUE(twice);
  EXPECT_EQ(twice->size(), 3u);
  const auto wrong = planRenderers("auto,impostor", 10, 10, {});
  ASSERT_FALSE(wrong);
  EXPECT_EQ(wrong.error().kind, ErrorKind::invalidArgument);
  EXPECT_NE(wrong.error().message.find("'impostor'"), std::string::npos);
  EXPECT_FALSE(planRenderers("auto,,A", 10, 10, {}));
}

Model modelAround(glm::dvec3 min, glm::dvec3 max, UpAxis up) {
  Model model;
  model.grid = gridAround(min, max);
  model.bounds.include(model.grid.gridFromWorld(min));
  model.bounds.include(model.grid.gridFromWorld(max));
  model.settings.up = up;
  return model;
}

class AutoCamerasOfAnAxis : public ::testing::TestWithParam<UpAxis> {};

TEST_P(AutoCamerasOfAnAxis, StandAtTheStatedDistancesAndElevationsAndLookAtTheCentre) {
  const glm::dvec3 min(100, 2000, -5), max(400, 2100, 35), centre = (min + max) * .5;
  const double radius = glm::length(max - min) / 2;
  const Model model = modelAround(min, max, GetParam());
  const auto viewpoints = Viewpoints::create(42);
  const std::vector<Camera> cameras = autoCameras(model, *viewpoints, 13);
  ASSERT_EQ(cameras.size(), 13u);
  std::set<std::string> names;
  for (size_t i = 0; i < cameras.size(); ++i) {
    const Camera& camera = cameras[i];
    names.insert(camera.name);
    const glm::dvec3 toEye = camera.position - centre;
    const double diameters = std::array{.25, .5, 1., 2., 4., 8.}[i % 6];
    EXPECT_NEAR((glm::length(toEye) - radius) / (2 * radius), diameters, 1e-5);
    const double elevation = std::asin(glm::dot(glm::normalize(toEye), upVector(GetParam()))) * 180 / std::numbers::pi;
    EXPECT_GT(elevation, 9.99);
    EXPECT_LT(elevation, 60.01);
    EXPECT_NEAR(glm::length(camera.target - centre), 0, 1e-4);
    EXPECT_EQ(camera.up, upVector(GetParam()));
    EXPECT_NEAR(camera.fovYRad, 40 * std::numbers::pi / 180, 1e-15);
  }
  EXPECT_EQ(names.size(), 13u);
}
INSTANTIATE_TEST_SUITE_P(EveryUpAxis, AutoCamerasOfAnAxis, ::testing::Values(UpAxis::x, UpAxis::y, UpAxis::z));

TEST(AutoCameras, StayFarFromBakedDirectionsAndFromEachOther) {
  const Model model = modelAround({-1, -1, -1}, {1, 1, 1}, UpAxis::z);
  for (const int views : {12, 42, 162}) {
    const auto viewpoints = Viewpoints::create(views);
    const std::vector<Camera> cameras = autoCameras(model, *viewpoints, 10);
    // Half the angle between neighbours: no direction can be much farther from all of them.
    const double spacing = std::sqrt(4 * std::numbers::pi / views) / 2;
    for (const Camera& camera : cameras) {
      const glm::dvec3 direction = glm::normalize(camera.position - camera.target);
      for (const glm::dvec3& baked : viewpoints->directions())
        EXPECT_GT(std::acos(glm::dot(direction, baked)), 0.85 * spacing) << views << " views, " << camera.name;
      for (const Camera& other : cameras) {
        if (&other == &camera) continue;
        EXPECT_LT(glm::dot(direction, glm::normalize(other.position - other.target)), std::cos(0.1)) << camera.name;
      }
    }
  }
}

TEST(AutoCameras, TheirFileReadsBackAsTheSameCameras) {
  const Model model = modelAround({450'000.123, 5e6, 3}, {451'000, 5.001e6, 90}, UpAxis::z);
  const std::vector<Camera> cameras = autoCameras(model, *Viewpoints::create(42), 7);
  const auto read = parseCameras(cameraFileText(cameras), "cameras.json");
  ASSERT_TRUE(read) << read.error().message;
  ASSERT_EQ(read->size(), cameras.size());
  for (size_t i = 0; i < cameras.size(); ++i) {
    EXPECT_EQ((*read)[i].name, cameras[i].name);
    EXPECT_EQ((*read)[i].position, cameras[i].position);
    EXPECT_EQ((*read)[i].target, cameras[i].target);
    EXPECT_EQ((*read)[i].up, cameras[i].up);
    EXPECT_NEAR((*read)[i].fovYRad, cameras[i].fovYRad, 1e-15);
  }
}

TEST(AutoCameras, OfAModelOfOnePointAreStillCameras) {
  const Model model = modelAround({3, 3, 3}, {3, 3, 3}, UpAxis::y);
  for (const Camera& camera : autoCameras(model, *Viewpoints::create(12), 6))
    EXPECT_GT(glm::length(camera.position - camera.target), 0);
}

}  // namespace
}  // namespace farcell
