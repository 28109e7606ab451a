#include <algorithm>
#include <cmath>

#include "cache/base/check.h"
#include "tools/evaluate/metrics/metrics.h"

namespace farcell {
namespace {

constexpr int kRadius = 5;
constexpr double kSigma = 1.5;
constexpr double kC1 = (0.01 * 255) * (0.01 * 255);
constexpr double kC2 = (0.03 * 255) * (0.03 * 255);

std::array<double, kRadius + 1> gaussianWeights() {
  std::array<double, kRadius + 1> weights;
  for (int i = 0; i <= kRadius; ++i) weights[static_cast<size_t>(i)] = std::exp(-i * i / (2 * kSigma * kSigma));
  return weights;
}

// One line of `count` values that lie `stride` apart, in place. Renormalising per axis is the same as renormalising
// the clipped square window, because the window is a product.
void blurLine(double* line, int count, size_t stride, std::vector<double>& scratch) {
  static const auto kWeights = gaussianWeights();
  for (int i = 0; i < count; ++i) scratch[static_cast<size_t>(i)] = line[static_cast<size_t>(i) * stride];
  for (int i = 0; i < count; ++i) {
    double sum = 0, weight = 0;
    for (int k = std::max(0, i - kRadius); k <= std::min(count - 1, i + kRadius); ++k) {
      const double w = kWeights[static_cast<size_t>(std::abs(k - i))];
      sum += w * scratch[static_cast<size_t>(k)];
      weight += w;
    }
    line[static_cast<size_t>(i) * stride] = sum / weight;
  }
}

void blur(std::vector<double>& plane, int width, int height) {
  std::vector<double> scratch(static_cast<size_t>(std::max(width, height)));
  for (int y = 0; y < height; ++y) blurLine(&plane[static_cast<size_t>(y) * width], width, 1, scratch);
  for (int x = 0; x < width; ++x) blurLine(&plane[static_cast<size_t>(x)], height, static_cast<size_t>(width), scratch);
}

std::vector<double> luma(std::span<const float> rgb) {
  std::vector<double> values(rgb.size() / 3);
  for (size_t i = 0; i < values.size(); ++i)
    values[i] = 0.299 * rgb[3 * i] + 0.587 * rgb[3 * i + 1] + 0.114 * rgb[3 * i + 2];
  return values;
}

std::vector<double> product(const std::vector<double>& a, const std::vector<double>& b) {
  std::vector<double> values(a.size());
  for (size_t i = 0; i < a.size(); ++i) values[i] = a[i] * b[i];
  return values;
}

}  // namespace

std::vector<double> structuralSimilarity(std::span<const float> a, std::span<const float> b, int width, int height) {
  const size_t pixels = static_cast<size_t>(width) * static_cast<size_t>(height);
  FARCELL_CHECK_EQ(a.size(), 3 * pixels);
  FARCELL_CHECK_EQ(b.size(), 3 * pixels);
  if (pixels == 0) return {};
  std::vector<double> meanA = luma(a), meanB = luma(b);
  std::vector<double> squareA = product(meanA, meanA), squareB = product(meanB, meanB), cross = product(meanA, meanB);
  for (std::vector<double>* plane : {&meanA, &meanB, &squareA, &squareB, &cross}) blur(*plane, width, height);

  std::vector<double> similarity(pixels);
  for (size_t i = 0; i < pixels; ++i) {
    const double mm = meanA[i] * meanB[i], aa = meanA[i] * meanA[i], bb = meanB[i] * meanB[i];
    similarity[i] =
        (2 * mm + kC1) * (2 * (cross[i] - mm) + kC2) / ((aa + bb + kC1) * (squareA[i] - aa + squareB[i] - bb + kC2));
  }
  return similarity;
}

}  // namespace farcell
