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
  const float light = shared::lightFactor(glm::vec3(0, 0, 1), sunDirection(UpAxis::z, Sun{}));
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

// Squares of size 2 above each other, seen from straight above or below: the picture's middle.
struct Middle {
  glm::vec3 rgb;
  float coverage;
};
Middle middleOf(const std::string& materials, const std::string& faces, double eyeZ, const std::string& image) {
  const TemporaryDirectory directory;
  std::ofstream(directory.path() / "holes.png", std::ios::binary) << image;
  std::ofstream(directory.path() / "squares.mtl") << materials;
  std::ofstream out(directory.path() / "squares.obj");
  out << "mtllib squares.mtl\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\n";
  for (const double z : {0.0, 0.1, 0.2})
    out << "v -1 -1 " << z << "\nv 1 -1 " << z << "\nv 1 1 " << z << "\nv -1 1 " << z << "\n";
  out << faces;
  out.close();
  const std::filesystem::path mesh = directory.path() / "squares.obj";
  BuildOptions options;
  options.settings.up = UpAxis::z;
  Progress silent(false);
  const auto built = buildPack({&mesh, 1}, directory.path() / "squares.far", options, silent);
  EXPECT_TRUE(built) << built.error().message;
  const auto reference = MeshReference::load({&mesh, 1}, built->directory, [](uint64_t) {});
  EXPECT_TRUE(reference) << reference.error().message;
  Camera camera;
  camera.position = {0, 0, eyeZ};
  camera.target = {0, 0, 0.1};
  camera.up = {0, 1, 0};
  camera.fovYRad = 0.3;
  const ReferenceImage traced = reference->trace(camera, {16, 16, 64, 1}).value();
  const size_t at = 8 * 16 + 8;
  return {glm::vec3(traced.rgb[3 * at], traced.rgb[3 * at + 1], traced.rgb[3 * at + 2]), traced.coverage[at]};
}

TEST(TransparentReference, LayersAreBlendedInTheOrderOfTheRay) {
  const std::string materials = "newmtl a\nKd 1 0 0\nd .25\nnewmtl b\nKd 0 1 0\nd .5\nnewmtl c\nKd 0 0 1\n";
  const std::string two = "usemtl a\nf 5 6 7 8\nusemtl b\nf 9 10 11 12\n";
  const float light = 255 * shared::lightFactor(glm::vec3(0, 0, 1), sunDirection(UpAxis::z, Sun{}));
  const double a = 64 / 255.0, b = 128 / 255.0;  // opacities as they are kept
  const auto expectRgb = [&](const Middle& found, glm::dvec3 expected, double coverage) {
    for (int channel = 0; channel < 3; ++channel)
      EXPECT_NEAR(found.rgb[channel], light * expected[channel], 0.1) << channel;
    EXPECT_NEAR(found.coverage, coverage, 1e-4);
  };
  expectRgb(middleOf(materials, two, 5, ""), {(1 - b) * a, b, 0}, 1 - (1 - a) * (1 - b));
  expectRgb(middleOf(materials, two, -5, ""), {a, (1 - a) * b, 0}, 1 - (1 - a) * (1 - b));
  const std::string three = two + "usemtl c\nf 1 2 3 4\n";
  expectRgb(middleOf(materials, three, 5, ""), {(1 - b) * a, b, (1 - a) * (1 - b)}, 1);
  expectRgb(middleOf(materials, three, -5, ""), {0, 0, 1}, 1);
}

TEST(TransparentReference, AMapOfOpacityMakesHoles) {
  const auto middleIs = [](int value) {
    return encodeImage("png", {64, 64, 1, 8}, [=](int x, int y, int) {
      return std::abs(x - 32) < 16 && std::abs(y - 32) < 16 ? value : 255 - value;
    });
  };
  const std::string materials = "newmtl a\nKd 1 1 1\nmap_d holes.png\n", face = "usemtl a\nf 5/1 6/2 7/3 8/4\n";
  EXPECT_EQ(middleOf(materials, face, 5, middleIs(0)).coverage, 0);
  EXPECT_EQ(middleOf(materials, face, 5, middleIs(255)).coverage, 1);
}

TEST(TexturedReference, AnImageThatCannotBeReadIsWhite) {
  TextureSource source;
  source.file = "/no/such/image.png";
  const WholeTextures textures = WholeTextures::read({&source, 1}).value();
  EXPECT_EQ(textures.colourAt(0, glm::vec2(.3f, .4f)), glm::vec4(1));
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
