// Packs whose views are lit when they are drawn.
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <random>

#include "shaders/shared/shading.h"
#include "tests/runtime/renderer_fixture.h"

namespace farcell {
namespace {

constexpr uint32_t kAlbedo = 0x0040a0e0;
const glm::vec3 kAlbedoColour(0xe0, 0xa0, 0x40);  // 0 to 255

DrawnPack openBall(Lighting lighting, Sun sun = {}) {
  return openDrawn(sphereTriangles({0, 0, 0}, 1, 5, kAlbedo), {.level = 1, .lighting = lighting, .sun = sun});
}

RenderSettings impostorsUnder(const Light& light, ImpostorKind kind = ImpostorKind::depthCorrected) {
  RenderSettings settings = sized(128, 128, RenderMode::impostors, 4, kind);
  settings.light = light;
  return settings;
}

Sun randomSun(std::mt19937& random) {
  std::uniform_real_distribution<double> azimuth(-std::numbers::pi, std::numbers::pi), height(-1, 1);
  return {azimuth(random), std::asin(height(random))};
}

// Where the ray through the middle of a pixel meets the unit ball at the origin: its normal there.
std::optional<glm::dvec3> ballNormal(const Camera& camera, int x, int y, int edge) {
  const CameraAxes axes = cameraAxes(camera);
  const double tangent = std::tan(camera.fovYRad / 2);
  const glm::dvec3 ray = glm::normalize(axes.right * ((2 * (x + 0.5) / edge - 1) * tangent) -
                                        axes.up * ((2 * (y + 0.5) / edge - 1) * tangent) - axes.back);
  const double along = -glm::dot(camera.position, ray);
  const double square = glm::dot(camera.position, camera.position) - along * along;
  if (square > 0.9) return std::nullopt;  // the rim, where a pixel is a wide part of the ball
  return camera.position + (along - std::sqrt(1 - square)) * ray;
}

// Mean over pixels and channels, 255ths.
double apartFromAnalytic(const FrameImage& image, const Camera& camera, glm::vec3 light) {
  double sum = 0;
  int count = 0;
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x) {
      const auto normal = ballNormal(camera, x, y, image.width);
      if (!normal) continue;
      const glm::vec3 expected = shared::shade(kAlbedoColour, glm::vec3(*normal), light);
      for (int channel = 0; channel < 3; ++channel) {
        sum += std::abs(image.rgba[static_cast<size_t>((y * image.width + x) * 4 + channel)] - expected[channel]);
        ++count;
      }
    }
  return sum / count;
}

TEST(Relit, aBallIsShadedAsItsNormalsSayUnderAnySun) {
  DrawnPack drawn = openBall(Lighting::relightable);
  const uint32_t seed = 19;
  SCOPED_TRACE(fmt::format("seed {}", seed));
  std::mt19937 random(seed);
  FrameImage image;
  for (int i = 0; i < 6; ++i) {
    const Sun sun = randomSun(random);
    const Camera camera = lookAt(glm::dvec3(sunDirection(UpAxis::z, randomSun(random))) * 6.0, {0, 0, 0}, 0.45);
    for (const ImpostorKind kind : {ImpostorKind::depthCorrected, ImpostorKind::blended}) {
      drawn.draw(camera, impostorsUnder({LightKind::sun, sun}, kind), image);
      EXPECT_LT(apartFromAnalytic(image, camera, sunDirection(UpAxis::z, sun)), 3) << sunText(sun);
      // The bound means something.
      EXPECT_GT(apartFromAnalytic(image, camera, sunDirection(UpAxis::z, {sun.azimuthRad + 1, -sun.elevationRad})), 6);
    }
  }
}

TEST(Relit, showsWhatAPackBakedUnderThatSunShows) {
  const uint32_t seed = 23;
  SCOPED_TRACE(fmt::format("seed {}", seed));
  std::mt19937 random(seed);
  const Sun sun = randomSun(random);
  DrawnPack relightable = openBall(Lighting::relightable), baked = openBall(Lighting::baked, sun);
  FrameImage relit, own;
  for (const ImpostorKind kind : {ImpostorKind::flat, ImpostorKind::depthCorrected, ImpostorKind::blended}) {
    const Camera camera = lookAt(glm::dvec3(sunDirection(UpAxis::z, randomSun(random))) * 6.0, {0, 0, 0}, 0.45);
    relightable.draw(camera, impostorsUnder({LightKind::sun, sun}, kind), relit);
    baked.draw(camera, impostorsUnder({}, kind), own);
    EXPECT_LT(difference(relit, own).mean, 1) << sunText(sun) << " kind " << static_cast<int>(kind);
  }
}

TEST(Relit, trianglesObeyTheLightToo) {
  DrawnPack drawn = openBall(Lighting::relightable);
  FrameImage triangles, impostors;
  const Camera camera = lookAt({5, -2, 3}, {0, 0, 0}, 0.45);
  for (const Light& light : {Light{}, Light{LightKind::sun, Sun{2, -0.3}}, Light{LightKind::headlight, {}}}) {
    RenderSettings settings = sized(128, 128, RenderMode::full);
    settings.light = light;
    drawn.draw(camera, settings, triangles);
    drawn.draw(camera, impostorsUnder(light), impostors);
    EXPECT_LT(difference(triangles, impostors).mean, 2) << lightText(light, drawn.pack->directory().model.settings);
    EXPECT_LT(
        apartFromAnalytic(triangles, camera, lightDirection(light, drawn.pack->directory().model.settings, camera)), 3);
  }
}

// Mean difference of a picture from its mirror images.
double asymmetry(const FrameImage& image) {
  double sum = 0;
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x) {
      const auto at = [&](int column, int row) {
        return image.rgba[static_cast<size_t>((row * image.width + column) * 4)];
      };
      sum += std::abs(at(x, y) - at(image.width - 1 - x, y)) + std::abs(at(x, y) - at(x, image.height - 1 - y));
    }
  return sum / (2.0 * image.width * image.height);
}

TEST(Headlight, lightsABallAlikeOnAllSidesOfItsMiddle) {
  DrawnPack drawn = openBall(Lighting::relightable);
  const Camera camera = lookAt({6, 0, 0}, {0, 0, 0}, 0.45);
  FrameImage image;
  for (const RenderMode mode : {RenderMode::full, RenderMode::impostors}) {
    RenderSettings settings = sized(128, 128, mode);
    drawn.draw(camera, settings, image);
    EXPECT_GT(asymmetry(image), 5);  // under the sun
    settings.light.kind = LightKind::headlight;
    drawn.draw(camera, settings, image);
    EXPECT_LT(asymmetry(image), 1);
    EXPECT_NEAR(image.rgba[(64 * 128 + 64) * 4], kAlbedoColour.x, 3);
  }
}

TEST(BakedLight, cannotBeChangedAndSaysSo) {
  const Sun own{0.5, 0.75};
  DrawnPack drawn = openBall(Lighting::baked, own);
  const Camera camera = lookAt({6, 0, 0}, {0, 0, 0});
  FrameImage image;
  for (const Light& light : {Light{}, Light{LightKind::sun, own}})
    EXPECT_TRUE(drawn.renderer->draw(camera, impostorsUnder(light), &image));
  for (const Light& light : {Light{LightKind::headlight, {}}, Light{LightKind::sun, Sun{0.5, 0.7}}}) {
    const auto refused = drawn.renderer->draw(camera, impostorsUnder(light), &image);
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().kind, ErrorKind::invalidArgument);
    for (const std::string& part : {drawn.pack->path(), sunText(own), std::string("--lighting relightable")})
      EXPECT_NE(refused.error().message.find(part), std::string::npos) << refused.error().message;
  }
}

}  // namespace
}  // namespace farcell
