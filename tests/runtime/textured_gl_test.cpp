// Near triangles show their textures: packs as the build makes them, against the image by its own formula.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>

#include "shaders/shared/shading.h"
#include "tests/runtime/built_pack.h"
#include "tests/support/gltf_writer.h"
#include "tests/support/images/encode_image.h"

namespace farcell {
namespace {

constexpr int kImageEdge = 64;
constexpr int kSquares = 8;    // of the checkerboard along an edge of the image
constexpr float kRepeats = 3;  // of the image along an edge of the quad
constexpr int kEdge = 192;     // of the picture

int checker(int x, int y, int channel) {
  const bool dark = (x * kSquares / kImageEdge + y * kSquares / kImageEdge) % 2 != 0;
  return dark ? 20 : 240 - 60 * channel;
}

// The square [-1, 1]^2 in the plane z = 0, and what is behind it.
DrawnPack checkeredQuad(uint64_t residentBytes = kPlentyBytes) {
  const auto write = [](const std::filesystem::path& mesh) -> Result<> {
    const auto beside = [&](const char* name) { return mesh.parent_path() / name; };
    std::ofstream(beside("quad.mtl")) << "newmtl board\nmap_Kd board.png\n";
    std::ofstream(beside("board.png"), std::ios::binary)
        << test::encodeImage("png", {kImageEdge, kImageEdge, 3, 8}, checker);
    std::ofstream(mesh) << "mtllib quad.mtl\nusemtl board\nv -1 -1 0\nv 1 -1 0\nv 1 1 0\nv -1 1 0\n"
                        << fmt::format("vt 0 0\nvt {0} 0\nvt {0} {0}\nvt 0 {0}\n", kRepeats)
                        << "f 1/1 2/2 3/3\nf 1/1 3/3 4/4\n";
    return {};
  };
  return buildDrawn("quad.obj", write, residentBytes);
}

Camera above(double height) {
  Camera camera = lookAt({0, 0, height}, {0, 0, 0}, 0.7);
  camera.up = glm::dvec3(0, 1, 0);
  return camera;
}

float lightOf(const DrawnPack& drawn) {
  return shared::lightFactor(glm::vec3(0, 0, 1), sunDirection(drawn.pack->directory().model.settings.up, Sun{}));
}

// Of the picture's pixel, whose row 0 is the top; 64 samples of the image, unfiltered.
glm::vec3 truthAt(int px, int py, double height, float light) {
  glm::dvec3 sum(0);
  for (int sample = 0; sample < 64; ++sample) {
    const double x = px + (sample % 8 + 0.5) / 8, y = py + (sample / 8 + 0.5) / 8;
    const double scale = 2 * height * std::tan(0.35) / kEdge;
    const double u = ((x - kEdge / 2) * scale + 1) / 2 * kRepeats, v = ((kEdge / 2 - y) * scale + 1) / 2 * kRepeats;
    const auto pixel = [](double at) { return static_cast<int>((at - std::floor(at)) * kImageEdge); };
    for (int channel = 0; channel < 3; ++channel)
      sum[channel] += static_cast<double>(light) * checker(pixel(u), kImageEdge - 1 - pixel(v), channel);
  }
  return glm::vec3(sum / 64.0);
}

// Over pixels inside the quad.
double meanError(const FrameImage& image, double height, float light) {
  const double reach = kEdge / 2 / (height * std::tan(0.35));
  const int first = std::max(0, static_cast<int>(kEdge / 2 - reach) + 2), last = kEdge - first;
  double sum = 0;
  for (int y = first; y < last; ++y)
    for (int x = first; x < last; ++x) {
      const glm::vec3 truth = truthAt(x, y, height, light);
      for (int channel = 0; channel < 3; ++channel)
        sum += std::abs(image.rgba[static_cast<size_t>(4 * (y * kEdge + x) + channel)] - truth[channel]) / 3;
    }
  return sum / ((last - first) * (last - first));
}

TEST(Textured, quadShowsItsRepeatedImageNearAndFar) {
  DrawnPack drawn = checkeredQuad();
  const float light = lightOf(drawn);
  FrameImage image;
  // A pixel is 1/8, 1/2 and 5 pixels of the image; edges between squares blur over one.
  for (const auto& [height, most] : {std::pair{0.09, 14.0}, {0.7, 25.0}, {7.0, 20.0}}) {
    drawn.draw(above(height), sized(kEdge, kEdge, RenderMode::full), image);
    EXPECT_LT(meanError(image, height, light), most) << height;
  }
  // The middles of squares, from near.
  const double height = 0.09;
  drawn.draw(above(height), sized(kEdge, kEdge, RenderMode::full), image);
  int same = 0;
  for (int y = 0; y < kEdge; y += 8)
    for (int x = 0; x < kEdge; x += 8) {
      const glm::vec3 truth = truthAt(x, y, height, light);
      same += std::abs(image.rgba[static_cast<size_t>(4 * (y * kEdge + x))] - truth.x) < 2;
    }
  EXPECT_GT(same, kEdge * kEdge / 64 * 3 / 4);
}

// A sheet of white that is a quarter there, in front of nothing: MTL's `d`.
TEST(Textured, aSheetThatIsAQuarterThereCoversAQuarter) {
  const auto write = [](const std::filesystem::path& mesh) -> Result<> {
    std::ofstream(mesh.parent_path() / "sheet.mtl") << "newmtl glass\nKd 1 1 1\nd 0.25\n";
    std::ofstream(mesh) << "mtllib sheet.mtl\nusemtl glass\nv -1 -1 0\nv 1 -1 0\nv 1 1 0\nv -1 1 0\n"
                        << "f 1 2 3\nf 1 3 4\n";
    return {};
  };
  DrawnPack drawn = buildDrawn("sheet.obj", write, kPlentyBytes);
  FrameImage image;
  drawn.draw(above(2), sized(kEdge, kEdge, RenderMode::full), image);
  double coverage = 0, colour = 0;
  for (size_t i = 0; i < image.rgba.size(); i += 4) colour += image.rgba[i], coverage += image.rgba[i + 3];
  const double pixels = kEdge * kEdge;
  EXPECT_NEAR(coverage / pixels / 255, 0.25, 0.01);
  EXPECT_NEAR(colour / coverage, lightOf(drawn), 0.02);  // its own colour where it is
}

// Two squares in the plane z = 0: on the left of one that is seen from its front only, on the right of one seen from
// both sides; facing +z. With an image, or plain.
DrawnPack twoSquares(bool withImage) {
  const auto write = [&](const std::filesystem::path& mesh) -> Result<> {
    test::GltfWriter writer;
    if (withImage) {
      const uint32_t view = writer.addView(test::encodeImage("png", {8, 8, 3, 8}, [](int, int, int) { return 200; }));
      writer.add("images", {{"bufferView", view}, {"mimeType", "image/png"}});
      writer.add("textures", {{"source", 0}});
    }
    for (const bool both : {false, true}) {
      const float left = both ? 0.0f : -1.0f;
      nlohmann::json material = {{"doubleSided", both}};
      if (withImage) material["pbrMetallicRoughness"] = {{"baseColorTexture", {{"index", 0}}}};
      const uint32_t positions = writer.addArray<float>(
          "VEC3", {left, -1, 0, left + 1, -1, 0, left + 1, 1, 0, left, -1, 0, left + 1, 1, 0, left, 1, 0});
      const uint32_t coordinates = writer.addArray<float>("VEC2", {0, 0, 1, 0, 1, 1, 0, 0, 1, 1, 0, 1});
      writer.show({{"attributes", {{"POSITION", positions}, {"TEXCOORD_0", coordinates}}},
                   {"material", writer.add("materials", material)}});
    }
    std::ofstream(mesh, std::ios::binary) << writer.glb();
    return {};
  };
  return buildDrawn("squares.glb", write, kPlentyBytes);
}

TEST(Textured, whatIsSeenFromItsFrontOnlyIsNotThereFromBehind) {
  for (const bool withImage : {false, true}) {
    DrawnPack drawn = twoSquares(withImage);
    ASSERT_TRUE(drawn.pack->directory().model.hasSides);
    EXPECT_EQ(drawn.pack->directory().cells[0].firstTexturePage != kNone, withImage);
    for (const double height : {2.0, -2.0})
      for (const RenderMode mode : {RenderMode::full, RenderMode::impostors}) {
        FrameImage image;
        drawn.draw(above(height), sized(kEdge, kEdge, mode), image);
        std::array<double, 2> coverage{};  // of the picture's halves
        for (size_t i = 0; i < image.rgba.size(); i += 4)
          coverage[i / 4 % kEdge < kEdge / 2 ? 0 : 1] += image.rgba[i + 3] / (255.0 * kEdge * kEdge / 2);
        std::sort(coverage.begin(), coverage.end());
        // The picture is 1.46 wide and high, all of it within the squares; in views a texel at their seam is a tenth.
        const double near = mode == RenderMode::full ? 0.005 : 0.06;
        EXPECT_NEAR(coverage[1], 1, near) << height;
        EXPECT_NEAR(coverage[0], height > 0 ? 1 : 0, near) << height << withImage;
      }
  }
}

TEST(Textured, picturesDoNotDependOnTheBytesThatTheGpuMayKeepButForFineness) {
  DrawnPack plenty = checkeredQuad(), little = checkeredQuad(4096);
  const float light = lightOf(plenty);
  FrameImage fine, coarse;
  plenty.draw(above(7), sized(kEdge, kEdge, RenderMode::full), fine);
  little.draw(above(7), sized(kEdge, kEdge, RenderMode::full), coarse);
  EXPECT_LT(meanError(coarse, 7, light), 2 * meanError(fine, 7, light) + 2);
  const FrameStats again = little.draw(above(7), sized(kEdge, kEdge, RenderMode::full), coarse);
  EXPECT_EQ(again.bytesRead, 0u);
}

}  // namespace
}  // namespace farcell
