#include "tools/evaluate/metrics/metrics.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace farcell {
namespace {

constexpr Colour kBlack = {0, 0, 0};

// A picture of one colour everywhere, fully covered.
ReferenceImage solidReference(int width, int height, Colour colour) {
  ReferenceImage image{width, height, {}, {}};
  for (int i = 0; i < 3 * width * height; ++i) image.rgb.push_back(colour[static_cast<size_t>(i % 3)]);
  image.coverage.assign(static_cast<size_t>(width * height), 1);
  return image;
}

void setReference(ReferenceImage& image, int x, int y, Colour premultiplied, float coverage) {
  const size_t pixel = static_cast<size_t>(y * image.width + x);
  for (size_t c = 0; c < 3; ++c) image.rgb[3 * pixel + c] = premultiplied[c];
  image.coverage[pixel] = coverage;
}

struct OwnedTest {
  int width, height;
  std::vector<uint8_t> rgba;
  std::vector<uint8_t> impostor;
  TestImage view() const { return {width, height, rgba, impostor}; }
  uint8_t* at(int x, int y) { return &rgba[static_cast<size_t>(4 * (y * width + x))]; }
};

OwnedTest solidTest(int width, int height, std::array<uint8_t, 4> rgba) {
  OwnedTest image{width, height, {}, {}};
  for (int i = 0; i < 4 * width * height; ++i) image.rgba.push_back(rgba[static_cast<size_t>(i % 4)]);
  return image;
}

TEST(Composite, LaysBothPicturesOverTheBackground) {
  ReferenceImage reference = solidReference(1, 1, {0, 0, 0});
  setReference(reference, 0, 0, {50, 25, 0}, 0.25f);
  const std::vector<float> truth = composite(reference, {100, 200, 40});
  EXPECT_FLOAT_EQ(truth[0], 50 + 75);
  EXPECT_FLOAT_EQ(truth[1], 25 + 150);
  EXPECT_FLOAT_EQ(truth[2], 30);

  const OwnedTest test = solidTest(1, 1, {51, 0, 10, 51});  // coverage 51 / 255 = 0.2
  const std::vector<float> own = composite(test.view(), {100, 200, 40});
  EXPECT_NEAR(own[0], 51 + 80, 1e-4);
  EXPECT_NEAR(own[1], 160, 1e-4);
  EXPECT_NEAR(own[2], 10 + 32, 1e-4);
}

TEST(Metrics, EqualPicturesHaveNoErrorAndTheCappedPsnr) {
  const ReferenceImage reference = solidReference(16, 9, {10, 20, 30});
  const Metrics m = measure(reference, solidTest(16, 9, {10, 20, 30, 255}).view(), kBlack);
  EXPECT_EQ(m.paperErrorSum, 0);
  EXPECT_EQ(m.paperError, 0);
  EXPECT_EQ(m.mae, 0);
  EXPECT_EQ(m.psnr, kMaxPsnrDb);
  EXPECT_NEAR(m.ssim, 1, 1e-12);
  EXPECT_EQ(m.p99, 0);
  EXPECT_EQ(m.holeRate, 0);
  EXPECT_EQ(m.leakRate, 0);
  EXPECT_EQ(m.coverageBias, 0);
  EXPECT_EQ(m.impostorShare, 0);
}

TEST(Metrics, AConstantOffsetHasTheClosedFormFigures) {
  const ReferenceImage reference = solidReference(20, 10, {100, 100, 100});
  const Metrics m = measure(reference, solidTest(20, 10, {101, 98, 104, 255}).view(), kBlack);  // d = 1, 2, 4
  EXPECT_DOUBLE_EQ(m.paperErrorSum, 7 * 200);
  EXPECT_DOUBLE_EQ(m.paperError, 7);
  EXPECT_DOUBLE_EQ(m.mae, 7.0 / 3);
  EXPECT_NEAR(m.psnr, 10 * std::log10(255 * 255 / 7.0), 1e-9);  // mean square (1 + 4 + 16) / 3 = 7
  EXPECT_EQ(m.p95, 4);
  EXPECT_EQ(m.p99, 4);
  EXPECT_EQ(m.interiorShare, 1);
  EXPECT_EQ(m.silhouetteShare, 0);
}

TEST(Metrics, ThePapersErrorDividesTheWholeImagesSumByTheForegroundsRectangle) {
  ReferenceImage reference = solidReference(10, 10, {0, 0, 0});
  for (float& coverage : reference.coverage) coverage = 0;
  setReference(reference, 2, 3, {200, 0, 0}, 1);
  setReference(reference, 5, 4, {200, 0, 0}, 1);  // rectangle 4 x 2
  OwnedTest test = solidTest(10, 10, {0, 0, 0, 0});
  test.at(2, 3)[0] = 190;  // 10 too dark
  test.at(2, 3)[3] = 255;
  test.at(5, 4)[0] = 200;
  test.at(5, 4)[3] = 255;
  test.at(9, 9)[1] = 6;  // a leak of 6 outside the rectangle
  test.at(9, 9)[3] = 6;
  const Metrics m = measure(reference, test.view(), kBlack);
  EXPECT_EQ(m.rectanglePixels, 8u);
  EXPECT_EQ(m.foregroundPixels, 2u);
  EXPECT_DOUBLE_EQ(m.paperErrorSum, 16);
  EXPECT_DOUBLE_EQ(m.paperError, 2);
  EXPECT_DOUBLE_EQ(m.mae, 10.0 / 6) << "the foreground alone";
  EXPECT_DOUBLE_EQ(m.leakRate, 0.5);
  EXPECT_DOUBLE_EQ(m.interiorShare, 10.0 / 16);
}

TEST(Metrics, HolesLeaksAndBiasFollowCoverage) {
  ReferenceImage reference = solidReference(10, 1, {0, 0, 0});
  OwnedTest test = solidTest(10, 1, {0, 0, 0, 255});
  for (int x = 6; x < 8; ++x) setReference(reference, x, 0, kBlack, 0);
  setReference(reference, 8, 0, kBlack, 0.5f);
  setReference(reference, 9, 0, kBlack, 0.5f);
  test.at(0, 0)[3] = 127;  // below .5: a hole
  test.at(1, 0)[3] = 128;  // just above: none
  test.at(6, 0)[3] = 5;    // .0196: no leak
  test.at(7, 0)[3] = 6;    // .0235: a leak
  test.at(8, 0)[3] = 0;    // half covered in the reference: no hole
  const Metrics m = measure(reference, test.view(), kBlack);
  EXPECT_DOUBLE_EQ(m.holeRate, 1.0 / 6);
  EXPECT_DOUBLE_EQ(m.leakRate, 1.0 / 8);
  EXPECT_NEAR(m.coverageBias, (127 + 128 + 4 * 255 + 11 + 0 + 255) / 255.0 / 7 - 1, 1e-12);
}

TEST(Metrics, TheErrorIsSplitBetweenSilhouetteAndInterior) {
  ReferenceImage reference = solidReference(4, 1, {100, 100, 100});
  setReference(reference, 0, 0, {50, 50, 50}, 0.5f);
  setReference(reference, 3, 0, kBlack, 0);
  OwnedTest test = solidTest(4, 1, {100, 100, 100, 255});
  test.at(0, 0)[0] = 44;                                       // 6, silhouette; its other channels 50 too bright
  test.at(1, 0)[0] = 94;                                       // 6, interior
  test.at(3, 0)[0] = test.at(3, 0)[1] = test.at(3, 0)[2] = 4;  // 12 where nothing should be
  const Metrics m = measure(reference, test.view(), kBlack);
  const double sum = (6 + 50 + 50) + 6 + 12;
  EXPECT_DOUBLE_EQ(m.paperErrorSum, sum);
  EXPECT_DOUBLE_EQ(m.silhouetteShare, 106 / sum);
  EXPECT_DOUBLE_EQ(m.interiorShare, 6 / sum);
}

TEST(Metrics, PercentilesAreTheNearestRank) {
  const ReferenceImage reference = solidReference(100, 1, {0, 0, 0});
  OwnedTest test = solidTest(100, 1, {0, 0, 0, 255});
  for (int x = 0; x < 100; ++x) test.at((x * 37) % 100, 0)[x % 3] = static_cast<uint8_t>(x + 1);  // 1 .. 100, shuffled
  const Metrics m = measure(reference, test.view(), kBlack);
  EXPECT_EQ(m.p95, 95);
  EXPECT_EQ(m.p99, 99);
}

TEST(Metrics, ImpostorShareIsTheirPartOfWhatIsDrawnInEachForegroundPixel) {
  ReferenceImage reference = solidReference(6, 1, {0, 0, 0});
  setReference(reference, 1, 0, kBlack, 0.25f);
  setReference(reference, 5, 0, kBlack, 0);
  OwnedTest test = solidTest(6, 1, {0, 0, 0, 255});
  test.at(1, 0)[3] = 60;  // a thin thing drawn by impostors alone
  test.at(3, 0)[3] = 0;   // a hole is nobody's
  test.impostor = {255, 60, 51, 0, 0, 255};
  EXPECT_NEAR(measure(reference, test.view(), kBlack).impostorShare, (1 + 1 + 0.2 + 0) / 4, 1e-12);
}

TEST(Metrics, AReferenceWithoutForegroundGivesFiniteFigures) {
  ReferenceImage reference = solidReference(3, 3, {0, 0, 0});
  for (float& coverage : reference.coverage) coverage = 0;
  const Metrics m = measure(reference, solidTest(3, 3, {9, 9, 9, 255}).view(), kBlack);
  EXPECT_EQ(m.foregroundPixels, 0u);
  EXPECT_EQ(m.paperErrorSum, 27 * 9);
  EXPECT_EQ(m.paperError, 0);
  EXPECT_EQ(m.leakRate, 0);
  EXPECT_EQ(m.coverageBias, 0);
  EXPECT_EQ(m.ssim, 1);
}

// Everything again, as the definitions read, in double and in two dimensions.
struct Naive {
  double sum = 0, mae = 0, mse = 0, ssim = 0, p95 = 0;
};

double lumaAt(const std::vector<double>& rgb, int width, int x, int y) {
  const size_t i = static_cast<size_t>(3 * (y * width + x));
  return 0.299 * rgb[i] + 0.587 * rgb[i + 1] + 0.114 * rgb[i + 2];
}

double naiveSsim(const std::vector<double>& a, const std::vector<double>& b, int width, int height, int px, int py) {
  double weights = 0, meanA = 0, meanB = 0;
  auto eachInWindow = [&](auto&& visit) {
    for (int y = std::max(0, py - 5); y <= std::min(height - 1, py + 5); ++y)
      for (int x = std::max(0, px - 5); x <= std::min(width - 1, px + 5); ++x)
        visit(std::exp(-((x - px) * (x - px) + (y - py) * (y - py)) / (2 * 1.5 * 1.5)), lumaAt(a, width, x, y),
              lumaAt(b, width, x, y));
  };
  eachInWindow([&](double w, double la, double lb) {
    weights += w;
    meanA += w * la;
    meanB += w * lb;
  });
  meanA /= weights;
  meanB /= weights;
  double varianceA = 0, varianceB = 0, covariance = 0;
  eachInWindow([&](double w, double la, double lb) {
    varianceA += w * (la - meanA) * (la - meanA) / weights;
    varianceB += w * (lb - meanB) * (lb - meanB) / weights;
    covariance += w * (la - meanA) * (lb - meanB) / weights;
  });
  const double c1 = 6.5025, c2 = 58.5225;
  return (2 * meanA * meanB + c1) * (2 * covariance + c2) /
         ((meanA * meanA + meanB * meanB + c1) * (varianceA + varianceB + c2));
}

Naive naive(const ReferenceImage& reference, const OwnedTest& test, const Colour& background) {
  std::vector<double> a, b;
  for (size_t i = 0; i < reference.coverage.size(); ++i)
    for (size_t c = 0; c < 3; ++c) {
      a.push_back(reference.rgb[3 * i + c] + (1.0 - reference.coverage[i]) * background[c]);
      b.push_back(test.rgba[4 * i + c] + (1.0 - test.rgba[4 * i + 3] / 255.0) * background[c]);
    }
  Naive result;
  std::vector<double> largest;
  for (size_t i = 0; i < reference.coverage.size(); ++i) {
    double sum = 0, squares = 0, most = 0;
    for (size_t c = 0; c < 3; ++c) {
      const double d = std::abs(a[3 * i + c] - b[3 * i + c]);
      sum += d;
      squares += d * d;
      most = std::max(most, d);
    }
    result.sum += sum;
    if (reference.coverage[i] <= 0) continue;
    result.mae += sum / 3;
    result.mse += squares / 3;
    largest.push_back(most);
    const int x = static_cast<int>(i) % reference.width, y = static_cast<int>(i) / reference.width;
    result.ssim += naiveSsim(a, b, reference.width, reference.height, x, y);
  }
  std::sort(largest.begin(), largest.end());
  result.p95 = largest[static_cast<size_t>(std::ceil(0.95 * static_cast<double>(largest.size()))) - 1];
  result.mae /= static_cast<double>(largest.size());
  result.mse /= static_cast<double>(largest.size());
  result.ssim /= static_cast<double>(largest.size());
  return result;
}

TEST(Metrics, RandomPicturesAgreeWithABruteForceComputation) {
  for (uint32_t seed = 1; seed <= 4; ++seed) {
    SCOPED_TRACE(seed);
    std::mt19937 random(seed);
    const int width = 7 + static_cast<int>(random() % 30), height = 3 + static_cast<int>(random() % 30);
    ReferenceImage reference{width, height, {}, {}};
    OwnedTest test{width, height, {}, {}};
    for (int i = 0; i < width * height; ++i) {
      const float coverage = static_cast<float>(random() % 65 < 40 ? 64 : random() % 65) / 64;
      const bool empty = i % 7 == 0;
      reference.coverage.push_back(empty ? 0 : coverage);
      const uint8_t alpha = static_cast<uint8_t>(random() % 256);
      for (int c = 0; c < 3; ++c) {
        reference.rgb.push_back(empty ? 0 : coverage * static_cast<float>(random() % 256));
        test.rgba.push_back(static_cast<uint8_t>(random() % (alpha + 1u)));
      }
      test.rgba.push_back(alpha);
    }
    const Colour background = {30, 90, 200};
    const Metrics m = measure(reference, test.view(), background);
    const Naive expected = naive(reference, test, background);
    EXPECT_NEAR(m.paperErrorSum, expected.sum, 1e-4 * expected.sum);
    EXPECT_NEAR(m.mae, expected.mae, 1e-4);
    EXPECT_NEAR(m.psnr, 10 * std::log10(255 * 255 / expected.mse), 1e-4);
    EXPECT_NEAR(m.p95, expected.p95, 1e-3);
    EXPECT_NEAR(m.ssim, expected.ssim, 1e-6);
  }
}

TEST(StructuralSimilarity, OfTwoConstantsIsTheLuminanceTermAlone) {
  const std::vector<float> a(3 * 30 * 20, 100.0f), b(3 * 30 * 20, 150.0f);
  const double expected = (2 * 100 * 150 + 6.5025) / (100 * 100 + 150 * 150 + 6.5025);
  for (const double value : structuralSimilarity(a, b, 30, 20)) ASSERT_NEAR(value, expected, 1e-9);
}

TEST(StructuralSimilarity, OfANegativeIsNegative) {
  std::vector<float> a, b;
  for (int y = 0; y < 24; ++y)
    for (int x = 0; x < 24; ++x)
      for (int c = 0; c < 3; ++c) {
        a.push_back((x + y) % 2 != 0 ? 255.0f : 0.0f);
        b.push_back((x + y) % 2 != 0 ? 0.0f : 255.0f);
      }
  const std::vector<double> similarity = structuralSimilarity(a, b, 24, 24);
  EXPECT_LT(similarity[12 * 24 + 12], -0.99);
}

}  // namespace
}  // namespace farcell
