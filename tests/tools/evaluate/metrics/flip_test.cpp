#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <random>
#include <string>

#include "tools/evaluate/metrics/metrics.h"

namespace farcell {
namespace {

// The paper's formulas as they read: every filter two-dimensional, everything in double, nothing shared with the
// implementation. Matrix and white point are the published decimals.
namespace oracle {

using Triple = std::array<double, 3>;

struct Image {
  int width, height;
  std::vector<Triple> pixels;
  const Triple& at(int x, int y) const {
    return pixels[static_cast<size_t>(std::clamp(y, 0, height - 1) * width + std::clamp(x, 0, width - 1))];
  }
};

constexpr Triple kWhite = {0.950428545, 1.0, 1.088900371};

Triple xyzFromLinear(const Triple& c) {
  return {0.412386563 * c[0] + 0.357591494 * c[1] + 0.180450494 * c[2],
          0.212636822 * c[0] + 0.715182989 * c[1] + 0.072180202 * c[2],
          0.019330620 * c[0] + 0.119197163 * c[1] + 0.950372599 * c[2]};
}

Triple linearFromXyz(const Triple& c) {
  return {3.241003275 * c[0] - 1.537398934 * c[1] - 0.498615861 * c[2],
          -0.969224334 * c[0] + 1.875930071 * c[1] + 0.041554224 * c[2],
          0.055639423 * c[0] - 0.204011202 * c[1] + 1.057148933 * c[2]};
}

Triple yccFromDisplay(const Triple& display) {
  Triple linear;
  for (size_t i = 0; i < 3; ++i) {
    const double s = display[i] / 255;
    linear[i] = s <= 0.04045 ? s / 12.92 : std::pow((s + 0.055) / 1.055, 2.4);
  }
  const Triple xyz = xyzFromLinear(linear);
  const double x = xyz[0] / kWhite[0], y = xyz[1] / kWhite[1], z = xyz[2] / kWhite[2];
  return {116 * y - 16, 500 * (x - y), 200 * (y - z)};
}

Triple linearFromYcc(const Triple& ycc) {
  const double y = (ycc[0] + 16) / 116;
  return linearFromXyz({(y + ycc[1] / 500) * kWhite[0], y * kWhite[1], (y - ycc[2] / 200) * kWhite[2]});
}

Triple huntLab(const Triple& linear) {
  const Triple xyz = xyzFromLinear(linear);
  double f[3];
  for (size_t i = 0; i < 3; ++i) {
    const double t = xyz[i] / kWhite[i];
    f[i] = t > 216.0 / 24389 ? std::cbrt(t) : (24389.0 / 27 * t + 16) / 116;
  }
  const double l = 116 * f[1] - 16;
  return {l, 0.01 * l * 500 * (f[0] - f[1]), 0.01 * l * 200 * (f[1] - f[2])};
}

double hyab(const Triple& a, const Triple& b) { return std::abs(a[0] - b[0]) + std::hypot(a[1] - b[1], a[2] - b[2]); }

double convolved(const Image& image, size_t channel, int x, int y, int radius,
                 const std::function<double(int, int)>& weight) {
  double sum = 0;
  for (int dy = -radius; dy <= radius; ++dy)
    for (int dx = -radius; dx <= radius; ++dx) sum += weight(dx, dy) * image.at(x + dx, y + dy)[channel];
  return sum;
}

// A filter's weights, tabulated.
struct Weights {
  int radius;
  std::vector<double> values;
  Weights(int r, const std::function<double(int, int)>& weight) : radius(r) {
    for (int y = -r; y <= r; ++y)
      for (int x = -r; x <= r; ++x) values.push_back(weight(x, y));
  }
  double operator()(int x, int y) const {
    return values[static_cast<size_t>((y + radius) * (2 * radius + 1) + x + radius)];
  }
};

Weights contrastSensitivity(double a1, double b1, double a2, double b2) {
  const double perPixel = 1 / 67.0, pi = std::acos(-1.0);
  const int radius = static_cast<int>(std::ceil(3 * std::sqrt(0.04 / (2 * pi * pi)) * 67));
  Weights weights(radius, [&](int x, int y) {
    const double d2 = (x * x + y * y) * perPixel * perPixel;
    return a1 * std::sqrt(pi / b1) * std::exp(-pi * pi * d2 / b1) +
           (a2 > 0 ? a2 * std::sqrt(pi / b2) * std::exp(-pi * pi * d2 / b2) : 0);
  });
  double sum = 0;
  for (const double value : weights.values) sum += value;
  for (double& value : weights.values) value /= sum;
  return weights;
}

Weights featureDetector(bool points, bool alongY) {
  const double s = 0.5 * 0.082 * 67;
  const int radius = static_cast<int>(std::ceil(3 * s));
  Weights weights(radius, [&](int x, int y) {
    const double along = alongY ? y : x, g = std::exp(-(x * x + y * y) / (2 * s * s));
    return points ? (along * along / (s * s) - 1) * g : -along * g;
  });
  double positive = 0, negative = 0;
  for (const double value : weights.values) (value > 0 ? positive : negative) += std::abs(value);
  for (double& value : weights.values) value /= value > 0 ? positive : negative;
  return weights;
}

std::vector<Triple> colours(const Image& ycc) {
  const Weights filters[] = {contrastSensitivity(1, 0.0047, 0, 1), contrastSensitivity(1, 0.0053, 0, 1),
                             contrastSensitivity(34.1, 0.04, 13.5, 0.025)};
  std::vector<Triple> result;
  for (int y = 0; y < ycc.height; ++y)
    for (int x = 0; x < ycc.width; ++x) {
      Triple seen;
      for (size_t c = 0; c < 3; ++c) seen[c] = convolved(ycc, c, x, y, filters[c].radius, filters[c]);
      Triple linear = linearFromYcc(seen);
      for (double& value : linear) value = std::clamp(value, 0.0, 1.0);
      result.push_back(huntLab(linear));
    }
  return result;
}

std::vector<double> features(Image ycc, bool points) {
  for (Triple& pixel : ycc.pixels) pixel[0] = (pixel[0] + 16) / 116;
  const Weights alongX = featureDetector(points, false), alongY = featureDetector(points, true);
  std::vector<double> result;
  for (int y = 0; y < ycc.height; ++y)
    for (int x = 0; x < ycc.width; ++x)
      result.push_back(
          std::hypot(convolved(ycc, 0, x, y, alongX.radius, alongX), convolved(ycc, 0, x, y, alongY.radius, alongY)));
  return result;
}

Image fromDisplay(const std::vector<float>& rgb, int width, int height) {
  Image image{width, height, {}};
  for (size_t i = 0; i < rgb.size(); i += 3) image.pixels.push_back(yccFromDisplay({rgb[i], rgb[i + 1], rgb[i + 2]}));
  return image;
}

std::vector<double> flip(const std::vector<float>& a, const std::vector<float>& b, int width, int height) {
  const Image imageA = fromDisplay(a, width, height), imageB = fromDisplay(b, width, height);
  const std::vector<Triple> coloursA = colours(imageA), coloursB = colours(imageB);
  const std::vector<double> edgesA = features(imageA, false), edgesB = features(imageB, false);
  const std::vector<double> pointsA = features(imageA, true), pointsB = features(imageB, true);
  const double most = std::pow(hyab(huntLab({0, 1, 0}), huntLab({0, 0, 1})), 0.7);
  std::vector<double> result;
  for (size_t i = 0; i < coloursA.size(); ++i) {
    const double d = std::pow(hyab(coloursA[i], coloursB[i]), 0.7);
    const double colour = d < 0.4 * most ? 0.95 / (0.4 * most) * d : 0.95 + (d - 0.4 * most) / (0.6 * most) * 0.05;
    const double feature =
        std::sqrt(std::max(std::abs(edgesA[i] - edgesB[i]), std::abs(pointsA[i] - pointsB[i])) / std::sqrt(2.0));
    result.push_back(std::pow(colour, 1 - feature));
  }
  return result;
}

}  // namespace oracle

using Picture = std::vector<float>;

Picture solid(int width, int height, Colour colour) {
  Picture picture;
  for (int i = 0; i < 3 * width * height; ++i) picture.push_back(colour[static_cast<size_t>(i % 3)]);
  return picture;
}

Picture noise(int width, int height, uint32_t seed) {
  std::mt19937 random(seed);
  Picture picture;
  for (int i = 0; i < 3 * width * height; ++i) picture.push_back(static_cast<float>(random() % 25501) / 100);
  return picture;
}

// Two coloured halves and a disc: edges, points and flat parts.
Picture shapes(int width, int height, double centreX, double centreY, double radius) {
  Picture picture;
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const bool inside = std::hypot(x - centreX, y - centreY) < radius;
      const Colour colour = inside ? Colour{250, 240, 20} : x + y < width ? Colour{20, 60, 160} : Colour{120, 10, 40};
      picture.insert(picture.end(), colour.begin(), colour.end());
    }
  return picture;
}

void expectOracle(const Picture& a, const Picture& b, int width, int height) {
  const std::vector<float> errors = flipErrors(a, b, width, height);
  const std::vector<double> expected = oracle::flip(a, b, width, height);
  ASSERT_EQ(errors.size(), expected.size());
  for (size_t i = 0; i < errors.size(); ++i) ASSERT_NEAR(errors[i], expected[i], 1e-4) << "pixel " << i;
}

TEST(Flip, OfRandomPicturesIsWhatThePapersFormulasSay) {
  for (uint32_t seed = 1; seed <= 3; ++seed) {
    SCOPED_TRACE(seed);
    std::mt19937 random(seed);
    const int width = 1 + static_cast<int>(random() % 40), height = 1 + static_cast<int>(random() % 40);
    expectOracle(noise(width, height, seed), noise(width, height, seed + 100), width, height);
  }
}

TEST(Flip, OfShapesIsWhatThePapersFormulasSay) {
  expectOracle(shapes(48, 40, 20, 20, 9), shapes(48, 40, 23.5, 19, 8), 48, 40);
  expectOracle(shapes(48, 40, 20, 20, 9), solid(48, 40, {20, 60, 160}), 48, 40);
  Picture dots = solid(40, 40, {200, 200, 200}), moved = dots;
  for (size_t i = 0; i < 40; i += 8) dots[3 * (40 * i + i)] = moved[3 * (40 * i + i + 2)] = 0;
  expectOracle(dots, moved, 40, 40);
}

TEST(Flip, OfPicturesOfOneColourFollowsFromTheirPublishedLab) {
  // sRGB's primaries in CIELAB (D65): green 87.73, -86.18, 83.18; blue 32.30, 79.19, -107.86; white 100, 0, 0.
  const double most =
      std::pow(87.73 - 32.30 + std::hypot(0.8773 * -86.18 - 0.3230 * 79.19, 0.8773 * 83.18 - 0.3230 * -107.86), 0.7);
  const double white = std::pow(100, 0.7);
  const std::vector<float> blackWhite = flipErrors(solid(30, 30, {0, 0, 0}), solid(30, 30, {255, 255, 255}), 30, 30);
  const std::vector<float> greenBlue = flipErrors(solid(30, 30, {0, 255, 0}), solid(30, 30, {0, 0, 255}), 30, 30);
  for (const float error : blackWhite) ASSERT_NEAR(error, 0.95 + (white - 0.4 * most) / (0.6 * most) * 0.05, 1e-4);
  for (const float error : greenBlue) ASSERT_NEAR(error, 1, 1e-5);
}

TEST(Flip, OfEqualPicturesIsNothing) {
  const Picture picture = noise(50, 30, 7);
  for (const float error : flipErrors(picture, picture, 50, 30)) ASSERT_EQ(error, 0);
  EXPECT_TRUE(flipErrors({}, {}, 0, 0).empty());
}

TEST(Flip, IsSymmetricAndWithinItsRange) {
  for (uint32_t seed = 1; seed <= 5; ++seed) {
    SCOPED_TRACE(seed);
    Picture a = noise(33, 21, seed), b = noise(33, 21, seed + 50);
    for (float& value : b) value = value > 128 ? 255.0f : 0.0f;  // the corners of the cube
    const std::vector<float> there = flipErrors(a, b, 33, 21), back = flipErrors(b, a, 33, 21);
    EXPECT_EQ(there, back);
    for (const float error : there) ASSERT_TRUE(error >= 0 && error <= 1) << error;
  }
}

TEST(Flip, ValuesBeyondDisplaysCountAsTheirLimits) {
  const Picture a = solid(12, 12, {300, -20, 255}), b = solid(12, 12, {255, 0, 255});
  for (const float error : flipErrors(a, b, 12, 12)) ASSERT_EQ(error, 0);
}

TEST(Flip, IsMeasuredOverTheWholeImageAndTheBackground) {
  // Half of the picture is empty in both; a leak there counts too.
  const int width = 24, height = 16;
  ReferenceImage reference{width, height, Picture(3 * width * height, 0.0f), std::vector<float>(width * height, 0.0f)};
  std::vector<uint8_t> rgba(4 * width * height, 0);
  for (size_t pixel = 0; pixel < reference.coverage.size(); ++pixel) {
    if (pixel % width < 12) {
      reference.coverage[pixel] = 1;
      for (size_t c = 0; c < 3; ++c) reference.rgb[3 * pixel + c] = 200;
      for (size_t c = 0; c < 4; ++c) rgba[4 * pixel + c] = c < 3 ? 190 : 255;
    } else if (pixel % 7 == 0) {
      rgba[4 * pixel + 3] = 255;
    }
  }
  const TestImage test{width, height, rgba, {}};
  const Colour background = {179, 204, 230};
  const std::vector<double> expected =
      oracle::flip(composite(reference, background), composite(test, background), width, height);
  double mean = 0;
  for (const double error : expected) mean += error / static_cast<double>(expected.size());
  std::vector<float> map;
  EXPECT_NEAR(measure(reference, test, background, &map).flip, mean, 1e-5);
  ASSERT_EQ(map.size(), expected.size());
  EXPECT_NEAR(map[100], expected[100], 1e-4);
}

}  // namespace
}  // namespace farcell
