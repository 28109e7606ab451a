#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <glm/vec2.hpp>

#include "cache/schema/model.h"
#include "preprocess/build/build.h"
#include "shaders/shared/shading.h"
#include "tests/support/evaluate_directory.h"
#include "tests/support/images/encode_image.h"
#include "tools/evaluate/reference/reference.h"
#include "tools/evaluate/reference/view.h"
#include "tools/evaluate/reference/whole_textures.h"

namespace farcell {
namespace {

using test::encodeImage;
using testing::TemporaryDirectory;

// The square [-1, 1]^2 in the plane z = 0 with an image of its own.
std::filesystem::path writeSquare(const std::filesystem::path& directory, const std::string& image) {
  std::ofstream(directory / "wall.png", std::ios::binary) << image;
  std::ofstream(directory / "square.mtl") << "newmtl wall\nmap_Kd wall.png\n";
  std::ofstream(directory / "square.obj") << "mtllib square.mtl\nusemtl wall\nv -1 -1 0\nv 1 -1 0\nv 1 1 0\nv -1 1 0\n"
                                             "vt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nf 1/1 2/2 3/3 4/4\n";
  return directory / "square.obj";
}

TEST(TexturedReference, ShowsTheImageItselfNotThePacksVertexColours) {
  const TemporaryDirectory directory;
  const auto image = encodeImage("png", {128, 128, 3, 8}, [](int x, int y, int channel) {
    return channel == 0 ? 2 * x : channel == 1 ? 2 * y : (x / 32 + y / 32) % 2 * 255;
  });
  const std::filesystem::path mesh = writeSquare(directory.path(), image);
  BuildOptions options;
  options.settings.up = UpAxis::z;
  Progress silent(false);
  const auto built = buildPack({&mesh, 1}, directory.path() / "square.far", options, silent);
  ASSERT_TRUE(built) << built.error().message;
  const auto reference = MeshReference::load({&mesh, 1}, built->directory, [](uint64_t) {});
  ASSERT_TRUE(reference) << reference.error().message;

  Camera camera;
  camera.position = {0.4, -0.3, 2};
  camera.target = {0.1, 0.1, 0};
  camera.up = {0, 1, 0};
  camera.fovYRad = 0.6;
  const ReferenceSettings settings{80, 60, 64, 1};
  const ReferenceImage traced = reference->trace(camera, settings).value();
  const ReferenceView view = referenceView(camera, settings.width, settings.height);
  const float light = shared::lightFactor(glm::vec3(0, 0, 1), sunDirection(UpAxis::z));
  int looked = 0;
  for (int y = 0; y < settings.height; ++y) {
    for (int x = 0; x < settings.width; ++x) {
      const glm::dvec3 ray = rayDirection(view, glm::dvec2(x + .5, y + .5));
      const glm::dvec3 hit = view.eye - ray * (view.eye.z / ray.z);
      const glm::dvec2 at = 64.0 * glm::dvec2(hit.x + 1, 1 - hit.y);  // pixels of the image, from its top left
      const auto edge = [](double value) { return std::abs(value / 32 - std::round(value / 32)) * 32; };
      if (std::abs(hit.x) > .97 || std::abs(hit.y) > .97 || edge(at.x) < 3 || edge(at.y) < 3) continue;
      ++looked;
      const auto* rgb = &traced.rgb[static_cast<size_t>(3 * (y * settings.width + x))];
      EXPECT_NEAR(rgb[0], light * 2 * (at.x - .5), 2);
      EXPECT_NEAR(rgb[1], light * 2 * (at.y - .5), 2);
      const bool white = (int(at.x / 32) + int(at.y / 32)) % 2 == 1;
      EXPECT_NEAR(rgb[2], white ? 255 * light : 0, 2);
    }
  }
  EXPECT_GT(looked, 1000);
}

TEST(TexturedReference, AnImageThatCannotBeReadIsWhite) {
  TextureSource source;
  source.file = "/no/such/image.png";
  const WholeTextures textures = WholeTextures::read({&source, 1}).value();
  EXPECT_EQ(textures.colourAt(0, glm::vec2(.3f, .4f)), glm::vec3(1));
}

TEST(TexturedReference, WrapModesRepeatMirrorAndClamp) {
  const TemporaryDirectory directory;
  const auto image = encodeImage("png", {64, 64, 1, 8}, [](int x, int, int) { return 4 * x; });
  std::ofstream(directory.path() / "ramp.png", std::ios::binary) << image;
  const auto grey = [&](TextureWrap wrap, float u) {
    TextureSource source;
    source.file = directory.path() / "ramp.png";
    source.wrapU = wrap;
    return WholeTextures::read({&source, 1}).value().colourAt(0, glm::vec2(u, .5f)).x;
  };
  for (const float u : {-3.3f, -1.8f, -0.3f, 0.4f, 1.2f, 2.7f}) {
    const float within = u - 2 * std::floor(u / 2);
    EXPECT_NEAR(grey(TextureWrap::repeat, u), u - std::floor(u), 0.02f) << u;
    EXPECT_NEAR(grey(TextureWrap::mirror, u), within < 1 ? within : 2 - within, 0.02f) << u;
    EXPECT_NEAR(grey(TextureWrap::clamp, u), std::clamp(u, 0.0f, 252 / 255.0f), 0.02f) << u;
  }
}

}  // namespace
}  // namespace farcell
