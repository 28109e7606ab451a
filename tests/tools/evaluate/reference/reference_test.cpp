#include "tools/evaluate/reference/reference.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>
#include <random>
#include <stdexcept>

#include "cache/schema/model.h"
#include "tests/support/evaluate_models.h"
#include "tools/evaluate/reference/view.h"

namespace farcell {
namespace {

using testing::sphereModel;
using testing::TemporaryDirectory;
using testing::TestModel;
using testing::writeTestPack;
using testing::writeTestPly;

Camera cameraAt(glm::dvec3 position, glm::dvec3 target, double fovYRad = 0.7) {
  Camera camera;
  camera.position = position;
  camera.target = target;
  camera.up = {0, 0, 1};
  camera.fovYRad = fovYRad;
  return camera;
}

ReferenceImage tracePack(const std::filesystem::path& path, const Camera& camera, const ReferenceSettings& settings) {
  const auto pack = PackFile::open(path);
  if (!pack) throw std::runtime_error(pack.error().message);
  const auto image = traceReference(*pack, camera, settings);
  if (!image) throw std::runtime_error(image.error().message);
  return *image;
}

ReferenceImage traceModel(const TestModel& model, const Camera& camera, const ReferenceSettings& settings,
                          bool oneLeaf = false) {
  const TemporaryDirectory directory;
  writeTestPack(model, directory.path() / "model.far", 1, oneLeaf);
  return tracePack(directory.path() / "model.far", camera, settings);
}

glm::vec3 colourAt(const ReferenceImage& image, int x, int y) {
  const size_t i = 3 * static_cast<size_t>(y * image.width + x);
  return {image.rgb[i], image.rgb[i + 1], image.rgb[i + 2]};
}

TEST(PackReference, ASpheresCoverageIsTheDiscsArea) {
  const glm::dvec3 centre(450'123.5, 5'412'345.25, 310);
  const double radius = 25, distance = 100;
  const ReferenceSettings settings{120, 100, 64, 0};
  const Camera camera = cameraAt(centre + glm::dvec3(distance, 0, 0), centre);
  const ReferenceImage image = traceModel(sphereModel(centre, radius, 6), camera, settings);
  ASSERT_EQ(image.coverage.size(), 12'000u);
  // The silhouette of a centred sphere is a circle of this tangent.
  const double pixels =
      radius / std::sqrt(distance * distance - radius * radius) / (2 * std::tan(camera.fovYRad / 2) / settings.height);
  double area = 0;
  for (int y = 0; y < settings.height; ++y)
    for (int x = 0; x < settings.width; ++x) {
      const float coverage = image.coverage[static_cast<size_t>(y * settings.width + x)];
      area += coverage;
      int inside = 0;
      for (int s = 0; s < 32 * 32; ++s)
        inside += std::hypot(x + (s % 32 + .5) / 32 - 60, y + (s / 32 + .5) / 32 - 50) < pixels ? 1 : 0;
      const double r = std::hypot(x + .5 - 60, y + .5 - 50);
      if (r > pixels + .75) {
        ASSERT_EQ(coverage, 0) << x << ", " << y;
      }
      if (r < pixels - .75) {
        ASSERT_EQ(coverage, 1) << x << ", " << y;
      }
      ASSERT_NEAR(coverage, inside / 1024.0, 0.12) << x << ", " << y;  // jittered samples of one edge
    }
  EXPECT_NEAR(area / (std::numbers::pi * pixels * pixels), 1, 1e-3);
}

TEST(PackReference, ASmoothSphereIsShadedByItsNormals) {
  const glm::dvec3 centre(5, -3, 2);
  const ReferenceSettings settings{60, 60, 64, 1};
  const Camera camera = cameraAt(centre + glm::dvec3(2, -6, 3), centre, 0.25);
  const ReferenceImage image = traceModel(sphereModel(centre, 1, 6), camera, settings);
  const ReferenceView view = referenceView(camera, 60, 60);
  const glm::dvec3 sun(sunDirection(UpAxis::z, Sun{}));
  int compared = 0;
  for (int y = 0; y < 60; ++y)
    for (int x = 0; x < 60; ++x) {
      const glm::dvec3 d = glm::normalize(rayDirection(view, {x + .5, y + .5})), toEye = view.eye - centre;
      const double b = glm::dot(d, toEye), disc = b * b - glm::dot(toEye, toEye) + 1;
      if (disc < 0.3) continue;  // away from the silhouette, where shading bends within a pixel
      const glm::dvec3 normal = toEye + d * (-b - std::sqrt(disc));
      const double cosine = std::abs(glm::dot(normal, sun));
      if (cosine < 0.05) continue;  // |cos| has a crease
      const double factor = 0.25 + 0.75 * cosine;
      const glm::vec3 colour = colourAt(image, x, y);
      ASSERT_NEAR(colour.x, 204 * factor, 0.6) << x << ", " << y;
      ASSERT_NEAR(colour.y, 200 * factor, 0.6);
      ASSERT_NEAR(colour.z, 192 * factor, 0.6);
      ++compared;
    }
  EXPECT_GT(compared, 500);
}

TEST(PackReference, APlaneHasExactlyItsLitColour) {
  TestModel model;
  model.grid = gridAround({-10, -10, -10}, {10, 10, 10});
  model.hasColours = true;
  const double edge = 10;
  for (const double sx : {-1., 1.})
    for (const double sy : {-1., 1.}) {
      InputTriangle triangle{};
      triangle.colours = {0x00204080, 0x00204080, 0x00204080};  // R 128, G 64, B 32
      triangle.positions = {glm::dvec3(0), glm::dvec3(sx * edge, 0, 0), glm::dvec3(sx * edge, sy * edge, 0)};
      model.triangles.push_back(triangle);
      triangle.positions = {glm::dvec3(0), glm::dvec3(sx * edge, sy * edge, 0), glm::dvec3(0, sy * edge, 0)};
      model.triangles.push_back(triangle);
    }
  const ReferenceImage image = traceModel(model, cameraAt({1, 2, 9}, {0.3, -0.2, 0}), {64, 48, 16, 0});
  const double factor = 0.25 + 0.75 * sunDirection(UpAxis::z, Sun{}).z;
  for (int y = 0; y < 48; ++y)
    for (int x = 0; x < 64; ++x) {
      ASSERT_EQ(image.coverage[static_cast<size_t>(y * 64 + x)], 1) << "no gap where octants meet: " << x << ", " << y;
      ASSERT_NEAR(colourAt(image, x, y).x, 128 * factor, 1e-3);
      ASSERT_NEAR(colourAt(image, x, y).y, 64 * factor, 1e-3);
      ASSERT_NEAR(colourAt(image, x, y).z, 32 * factor, 1e-3);
    }
}

// A sheet over another, and seen from its front only.
TEST(PackReference, WhatIsSeenFromItsFrontOnlyIsNotThereFromBehind) {
  TestModel model;
  model.grid = gridAround({-10, -10, -10}, {10, 10, 10});
  model.hasColours = model.hasSides = true;
  for (const auto& [z, colour] : {std::pair{2.0, 0x00204080u | kSeenFromFront}, {1.0, 0x00ff0000u}}) {
    InputTriangle triangle{};
    triangle.colours.fill(colour);
    triangle.positions = {glm::dvec3(1, 1, z), glm::dvec3(9, 1, z), glm::dvec3(5, 9, z)};
    model.triangles.push_back(triangle);
  }
  const Camera above = cameraAt({5, 4.1, 9}, {5, 4, 0}), below = cameraAt({5, 4.1, -9}, {5, 4, 0});
  const ReferenceSettings settings{8, 8, 16, 0};
  EXPECT_GT(colourAt(traceModel(model, above, settings), 4, 4).x, 20) << "the upper sheet";
  EXPECT_EQ(colourAt(traceModel(model, below, settings), 4, 4).x, 0) << "the lower sheet hides it";
  model.triangles.pop_back();
  EXPECT_EQ(traceModel(model, above, settings).coverage[36], 1);
  EXPECT_EQ(traceModel(model, below, settings).coverage[36], 0);
}

// Triangles anywhere in the octants of [-1, 1]^3 around `offset`, each corner of its own colour.
TestModel randomModel(uint32_t seed, glm::dvec3 offset, int count) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> unit(0, 1);
  TestModel model;
  model.grid = gridAround(offset - 1.0, offset + 1.0);
  model.hasColours = true;
  const glm::dvec3 centre = cellCentre(model.grid, {});
  for (int t = 0; t < count; ++t) {
    const glm::dvec3 octant(random() % 2 != 0 ? 1 : -1, random() % 2 != 0 ? 1 : -1, random() % 2 != 0 ? 1 : -1);
    const glm::dvec3 corner(unit(random), unit(random), unit(random));
    InputTriangle triangle{};
    for (size_t k = 0; k < 3; ++k) {
      const glm::dvec3 wish = corner + 0.5 * glm::dvec3(unit(random), unit(random), unit(random)) - 0.25;
      const glm::dvec3 world = centre + octant * glm::clamp(wish, 0.0, 1.0);
      triangle.positions[k] = model.grid.worldFromGrid(model.grid.gridFromWorld(world));
      triangle.colours[k] = static_cast<uint32_t>(random() & 0xffffff);
    }
    model.triangles.push_back(triangle);
  }
  return model;
}

// The nearest hit of a ray by the textbook, in double, over all triangles.
struct Hit {
  double distance = INFINITY, u = 0, v = 0;
  const InputTriangle* triangle = nullptr;
};

Hit nearestHit(const TestModel& model, glm::dvec3 eye, glm::dvec3 direction) {
  Hit nearest;
  for (const InputTriangle& triangle : model.triangles) {
    const glm::dvec3 e1 = triangle.positions[1] - triangle.positions[0],
                     e2 = triangle.positions[2] - triangle.positions[0];
    const glm::dvec3 p = glm::cross(direction, e2), s = eye - triangle.positions[0], q = glm::cross(s, e1);
    const double determinant = glm::dot(e1, p);
    if (determinant == 0) continue;
    const double u = glm::dot(s, p) / determinant, v = glm::dot(direction, q) / determinant;
    const double t = glm::dot(e2, q) / determinant;
    if (u >= 0 && v >= 0 && u + v <= 1 && t > 0 && t < nearest.distance) nearest = {t, u, v, &triangle};
  }
  return nearest;
}

glm::dvec3 litColour(const Hit& hit) {
  const auto channels = [](uint32_t c) { return glm::dvec3(c & 255, c >> 8 & 255, c >> 16 & 255); };
  const auto& colours = hit.triangle->colours;
  const glm::dvec3 albedo =
      channels(colours[0]) * (1 - hit.u - hit.v) + channels(colours[1]) * hit.u + channels(colours[2]) * hit.v;
  const auto& p = hit.triangle->positions;
  const glm::dvec3 normal = glm::normalize(glm::cross(p[1] - p[0], p[2] - p[0]));
  return albedo * (0.25 + 0.75 * std::abs(glm::dot(normal, glm::dvec3(sunDirection(UpAxis::z, Sun{})))));
}

TEST(PackReference, AgreesWithABruteForceRayCasterFromOutsideAndInside) {
  constexpr int kWidth = 32, kHeight = 24, kPerAxis = 2;
  const glm::dvec3 offset(1234.5, -777, 55);
  for (uint32_t seed = 1; seed <= 8; ++seed) {
    SCOPED_TRACE(seed);
    const TestModel model = randomModel(seed, offset, 150);
    std::mt19937 random(seed);
    const double far = seed <= 4 ? 4 : 0.4;
    const glm::dvec3 eye =
        offset + far * glm::normalize(glm::dvec3(random() % 100, random() % 100, random() % 100) - 49.5);
    const Camera camera = cameraAt(eye, seed <= 4 ? offset : offset + glm::dvec3(0.1, 0.2, 0.3), 0.9);
    const ReferenceImage image = traceModel(model, camera, {kWidth, kHeight, kPerAxis * kPerAxis, 2});
    const ReferenceView view = referenceView(camera, kWidth, kHeight);
    int wrong = 0, covered = 0;
    for (int y = 0; y < kHeight; ++y)
      for (int x = 0; x < kWidth; ++x) {
        glm::dvec3 sum(0);
        int hits = 0;
        for (int s = 0; s < kPerAxis * kPerAxis; ++s) {
          const Hit hit =
              nearestHit(model, eye, rayDirection(view, glm::dvec2(x, y) + samplePosition(x, y, s, kPerAxis)));
          if (hit.triangle == nullptr) continue;
          sum += litColour(hit) / 4.0;
          ++hits;
        }
        covered += hits > 0 ? 1 : 0;
        const bool same = image.coverage[static_cast<size_t>(y * kWidth + x)] == static_cast<float>(hits) / 4 &&
                          glm::length(glm::dvec3(colourAt(image, x, y)) - sum) < 0.05;
        wrong += same ? 0 : 1;
      }
    EXPECT_GT(covered, 50);
    EXPECT_LE(wrong, 1) << "a ray may pass an edge within float rounding";
  }
}

TEST(PackReference, DoesNotDependOnThreadsOrOnHowTheModelIsCut) {
  const TestModel model = sphereModel({0, 0, 0}, 1, 4);
  const Camera camera = cameraAt({3, 1, 1}, {0, 0, 0});
  const ReferenceImage one = traceModel(model, camera, {50, 40, 9, 1});
  const ReferenceImage three = traceModel(model, camera, {50, 40, 9, 3});
  EXPECT_EQ(one.rgb, three.rgb);
  EXPECT_EQ(one.coverage, three.coverage);
  const ReferenceImage whole = traceModel(model, camera, {50, 40, 9, 1}, true);
  int different = 0;
  for (size_t i = 0; i < one.rgb.size(); ++i) different += std::abs(one.rgb[i] - whole.rgb[i]) > 0.5f ? 1 : 0;
  EXPECT_LE(different, 6) << "rays within float rounding of an edge";
}

TEST(PackReference, AModelBehindTheCameraGivesAnEmptyPicture) {
  const ReferenceImage image = traceModel(sphereModel({0, 0, 0}, 1, 2), cameraAt({5, 0, 0}, {9, 0, 0}), {16, 16, 4, 0});
  EXPECT_EQ(*std::max_element(image.coverage.begin(), image.coverage.end()), 0);
}

TEST(PackReference, SurvivesACameraFartherThanFloatsReach) {
  const ReferenceImage image =
      traceModel(sphereModel({0, 0, 0}, 1e-6, 2), cameraAt({1e25, 1e24, 0}, {0, 0, 0}), {8, 8, 4, 0});
  EXPECT_EQ(image.coverage.size(), 64u);
}

TEST(PackReference, ASampleCountThatIsNoSquareIsRefused) {
  for (const int samples : {0, -4, 2, 8, 63, 65, 81, 100}) {
    const auto checked = checkReferenceSamples(samples);
    ASSERT_FALSE(checked) << samples;
    EXPECT_EQ(checked.error().kind, ErrorKind::invalidArgument);
  }
  for (const int samples : {1, 4, 9, 16, 25, 36, 49, 64}) EXPECT_TRUE(checkReferenceSamples(samples)) << samples;
}

// The same picture from the original file and from its pack.
void expectMeshAndPackAgree(const TestModel& model, const Camera& camera) {
  const TemporaryDirectory directory;
  const uint64_t hash = writeTestPly(model, directory.path() / "model.ply");
  writeTestPack(model, directory.path() / "model.far", hash);
  const auto pack = PackFile::open(directory.path() / "model.far");
  ASSERT_TRUE(pack) << pack.error().message;
  uint64_t told = 0;
  const std::filesystem::path path = directory.path() / "model.ply";
  const auto mesh = MeshReference::load({&path, 1}, pack->directory(), [&](uint64_t triangles) { told += triangles; });
  ASSERT_TRUE(mesh) << mesh.error().message;
  EXPECT_EQ(mesh->triangles(), model.triangles.size());
  EXPECT_EQ(told, model.triangles.size());
  const ReferenceSettings settings{64, 48, 16, 0};
  const auto fromMesh = mesh->trace(camera, settings);
  const auto fromPack = traceReference(*pack, camera, settings);
  ASSERT_TRUE(fromMesh && fromPack);
  double covered = 0;
  int different = 0;
  for (size_t i = 0; i < fromMesh->coverage.size(); ++i) {
    covered += fromMesh->coverage[i];
    bool same = fromMesh->coverage[i] == fromPack->coverage[i];
    for (size_t c = 0; c < 3; ++c) same = same && std::abs(fromMesh->rgb[3 * i + c] - fromPack->rgb[3 * i + c]) < 0.1f;
    different += same ? 0 : 1;
  }
  EXPECT_GT(covered, 300);
  EXPECT_LE(different, 8) << "of 3072 pixels: rays near an edge, which the grid moves by up to half a step";
}

TEST(MeshReference, AgreesWithThePackOnASmoothSphereFarFromTheOrigin) {
  const glm::dvec3 centre(450'123.5, 5'412'345.25, 310);
  expectMeshAndPackAgree(sphereModel(centre, 25, 4), cameraAt(centre + glm::dvec3(80, 20, 30), centre));
}

TEST(MeshReference, AgreesWithThePackOnColouredFlatTriangles) {
  const glm::dvec3 offset(-3, 12, 1e4);
  expectMeshAndPackAgree(randomModel(11, offset, 200), cameraAt(offset + glm::dvec3(3, 2, 1), offset));
}

TEST(MeshReference, AnotherFileIsRefusedWithBothHashes) {
  const TemporaryDirectory directory;
  const TestModel model = sphereModel({0, 0, 0}, 1, 1);
  const uint64_t hash = writeTestPly(model, directory.path() / "other.ply");
  writeTestPack(model, directory.path() / "model.far", hash ^ 0xff);
  const auto pack = PackFile::open(directory.path() / "model.far");
  ASSERT_TRUE(pack);
  const std::filesystem::path path = directory.path() / "other.ply";
  const auto mesh = MeshReference::load({&path, 1}, pack->directory(), [](uint64_t) {});
  ASSERT_FALSE(mesh);
  EXPECT_EQ(mesh.error().kind, ErrorKind::invalidArgument);
  EXPECT_NE(mesh.error().message.find(fmt::format("{:016x}", hash)), std::string::npos) << mesh.error().message;
  EXPECT_NE(mesh.error().message.find(fmt::format("{:016x}", hash ^ 0xff)), std::string::npos) << mesh.error().message;
}

}  // namespace
}  // namespace farcell
