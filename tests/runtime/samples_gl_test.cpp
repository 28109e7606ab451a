// Pictures of several samples a pixel against what they stand for: means over the squares of pixels.
#include <cmath>
#include <numbers>
#include <random>

#include "tests/runtime/renderer_fixture.h"

namespace farcell {
namespace {

constexpr uint32_t kBright = 0x00ffffff;

double squared(double v) { return v > 0 ? v * v : 0; }

// Of the unit square where a x + b y < d.
double halfPlaneCoverage(double a, double b, double d) {
  d -= std::min(a, 0.0) + std::min(b, 0.0);
  a = std::abs(a), b = std::abs(b);
  return (squared(d) - squared(d - a) - squared(d - b) + squared(d - a - b)) / (2 * a * b);
}

struct EdgeErrors {
  double rms = 0;        // of the pixels that the edge crosses
  double elsewhere = 0;  // worst of the others, but for the rim of the picture
};

// Of a picture where x cos + y sin < offset is covered; x, y in pixels from the middle, y up.
EdgeErrors edgeErrors(const FrameImage& image, double angleRad, double offset) {
  const double a = std::cos(angleRad), b = std::sin(angleRad);
  double sum = 0;
  int count = 0;
  EdgeErrors errors;
  for (int y = 1; y + 1 < image.height; ++y)
    for (int x = 1; x + 1 < image.width; ++x) {
      const double left = x - image.width / 2.0, bottom = image.height / 2.0 - (y + 1);
      const double truth = halfPlaneCoverage(a, b, offset - a * left - b * bottom);
      const double error = alphaAt(image, x, y) / 255.0 - truth;
      if (truth > 0 && truth < 1) {
        sum += error * error;
        ++count;
      } else {
        errors.elsewhere = std::max(errors.elsewhere, std::abs(error));
      }
    }
  errors.rms = std::sqrt(sum / count);
  return errors;
}

TEST(Samples, coverTheSharesOfPixelsBesideAnEdge) {
  std::mt19937 random(static_cast<uint32_t>(::testing::UnitTest::GetInstance()->random_seed()));
  std::uniform_real_distribution<double> unit(0, 1);
  constexpr int kEdgePixels = 96;
  constexpr double kAway = 4, kFovYRad = 0.5;
  const double worldPerPixel = 2 * kAway * std::tan(kFovYRad / 2) / kEdgePixels;
  for (int round = 0; round < 3; ++round) {
    const double angle = 2 * std::numbers::pi * unit(random), offset = 4 * unit(random) - 2;
    SCOPED_TRACE(fmt::format("angle {}, offset {}", angle, offset));
    // In the plane x = 0, seen from +x: y to the right, z up.
    const glm::dvec3 across(0, std::cos(angle), std::sin(angle)), along(0, -std::sin(angle), std::cos(angle));
    const glm::dvec3 middle = across * (offset * worldPerPixel);
    DrawnPack drawn = openDrawn({{{middle - 9.0 * along, middle + 9.0 * along, middle - 9.0 * across}, kBright}},
                                {.level = 1, .withViews = false});
    const Camera camera = lookAt({kAway, 0, 0}, {0, 0, 0}, kFovYRad);
    for (const auto& [samples, bound] : {std::pair{4, 0.13}, {8, 0.1}, {16, 0.055}, {64, 0.025}}) {
      FrameImage image;
      drawn.draw(camera, sized(kEdgePixels, kEdgePixels, RenderMode::triangles, samples), image);
      const EdgeErrors errors = edgeErrors(image, angle, offset);
      EXPECT_LT(errors.rms, bound) << samples;
      EXPECT_LT(errors.elsewhere, 0.003) << samples;
    }
  }
}

// Means of squares of 8 x 8 pixels.
std::vector<double> shrunk(const FrameImage& image) {
  const int width = image.width / 8, height = image.height / 8;
  std::vector<double> means(static_cast<size_t>(width * height * 4));
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x)
      for (int channel = 0; channel < 4; ++channel)
        means[static_cast<size_t>(((y / 8) * width + x / 8) * 4 + channel)] +=
            image.rgba[static_cast<size_t>((y * image.width + x) * 4 + channel)] / 64.0;
  return means;
}

double meanError(const FrameImage& image, const std::vector<double>& truth) {
  double sum = 0;
  for (size_t i = 0; i < truth.size(); ++i) sum += std::abs(image.rgba[i] - truth[i]);
  return sum / static_cast<double>(truth.size());
}

TEST(Samples, ofMorePassesComeNearerToALargePictureMadeSmall) {
  DrawnPack drawn = openDrawn(sphereTriangles({0, 0, 0}, 5, 3, kBright), {.level = 1, .views = 12, .imageSize = 32});
  const Camera camera = lookAt({20, 3, 4}, {0, 0, 0});
  FrameImage large;
  drawn.draw(camera, sized(8 * 120, 8 * 90, RenderMode::full, 1), large);
  const std::vector<double> truth = shrunk(large);
  std::vector<double> errors;
  for (const int samples : {1, 4, 8, 16, 64}) {
    FrameImage image;
    drawn.draw(camera, sized(120, 90, RenderMode::full, samples), image);
    errors.push_back(meanError(image, truth));
  }
  for (size_t i = 1; i < errors.size(); ++i) EXPECT_LT(errors[i], 0.85 * errors[i - 1]) << i;
  EXPECT_LT(errors.back(), 0.35 * errors[1]);
}

// Triangles near by, impostors from afar; where time is short, the fewer samples.
TEST(Samples, asNeededAreEightOfTrianglesAndFourOfImpostors) {
  DrawnPack drawn = openDrawn(sphereTriangles({0, 0, 0}, 5, 3, kBright), {.level = 1, .views = 12, .imageSize = 32});
  const auto samplesFrom = [&](double distance, double timeBudgetMs) {
    RenderSettings settings = sized(96, 72, RenderMode::automatic, kSamplesAsNeeded);
    settings.selection.timeBudgetMs = timeBudgetMs;
    FrameImage image;
    const FrameStats stats = drawn.draw(lookAt({distance, 3, 4}, {0, 0, 0}), settings, image);
    EXPECT_EQ(stats.impostors == 0, stats.triangles > 0) << distance;
    FrameImage same;
    drawn.draw(lookAt({distance, 3, 4}, {0, 0, 0}), sized(96, 72, RenderMode::automatic, stats.samples), same);
    if (timeBudgetMs == 0) {
      EXPECT_EQ(image.rgba, same.rgba) << "no picture of its own";
    }
    return stats.samples;
  };
  EXPECT_EQ(samplesFrom(20, 0), 8);
  EXPECT_EQ(samplesFrom(2000, 0), 4);
  EXPECT_EQ(samplesFrom(20, 1e-6), 4);
}

}  // namespace
}  // namespace farcell
