#include "tools/evaluate/metrics/metrics.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "cache/base/check.h"

namespace farcell {
namespace {

struct Rectangle {
  int x0 = 0, y0 = 0, x1 = 0, y1 = 0;  // pixels, x1 and y1 exclusive; empty when no pixel was included

  void include(int x, int y) {
    if (x1 == x0) *this = {x, y, x + 1, y + 1};
    *this = {std::min(x0, x), std::min(y0, y), std::max(x1, x + 1), std::max(y1, y + 1)};
  }
  uint64_t pixels() const { return static_cast<uint64_t>(x1 - x0) * static_cast<uint64_t>(y1 - y0); }
};

Rectangle foregroundRectangle(const ReferenceImage& reference) {
  Rectangle rectangle;
  for (int y = 0; y < reference.height; ++y)
    for (int x = 0; x < reference.width; ++x)
      if (reference.coverage[static_cast<size_t>(y) * reference.width + x] > 0) rectangle.include(x, y);
  return rectangle;
}

// The smallest value that at least `share` of all values do not exceed.
double percentile(std::vector<float>& values, double share) {
  if (values.empty()) return 0;
  const auto count = static_cast<double>(values.size());
  const auto rank = static_cast<size_t>(std::clamp(std::ceil(share * count), 1.0, count));
  const auto place = values.begin() + static_cast<std::ptrdiff_t>(rank - 1);
  std::nth_element(values.begin(), place, values.end());
  return *place;
}

double ratio(double part, double whole) { return whole > 0 ? part / whole : 0; }

// Everything that is a function of single pixels.
struct Sums {
  double absolute = 0, foreground = 0, squares = 0, silhouette = 0, interior = 0, ssim = 0, flip = 0, impostor = 0;
  double coverage = 0, referenceCoverage = 0;
  uint64_t solid = 0, holes = 0, leaks = 0, drawn = 0;
  std::vector<float> largest;  // of the three channels, foreground pixels
};

void addCoverage(Sums& sums, double reference, double own) {
  sums.referenceCoverage += reference;
  sums.coverage += own;
  if (reference > kHoleReferenceCoverage) {
    ++sums.solid;
    if (own < kHoleCoverage) ++sums.holes;
  }
  if (reference == 0 && own > kLeakCoverage) ++sums.leaks;
}

void addImpostor(Sums& sums, const TestImage& test, size_t pixel) {
  const int own = test.rgba[4 * pixel + 3];
  if (own == 0) return;
  ++sums.drawn;
  if (!test.impostorCoverage.empty()) sums.impostor += std::min<double>(test.impostorCoverage[pixel], own) / own;
}

void addDifference(Sums& sums, double coverage, const float* a, const float* b) {
  double absolute = 0, squares = 0;
  float largest = 0;
  for (int c = 0; c < 3; ++c) {
    const float d = std::abs(a[c] - b[c]);
    absolute += d;
    squares += static_cast<double>(d) * d;
    largest = std::max(largest, d);
  }
  sums.absolute += absolute;
  if (coverage <= 0) return;
  (coverage < 1 ? sums.silhouette : sums.interior) += absolute;
  sums.foreground += absolute;
  sums.squares += squares;
  sums.largest.push_back(largest);
}

Sums sumUp(const ReferenceImage& reference, const TestImage& test, const Colour& background, std::vector<float>& flip) {
  const std::vector<float> truth = composite(reference, background);
  const std::vector<float> own = composite(test, background);
  const std::vector<double> ssim = structuralSimilarity(truth, own, reference.width, reference.height);
  flip = flipErrors(truth, own, reference.width, reference.height);
  Sums sums;
  for (size_t pixel = 0; pixel < reference.coverage.size(); ++pixel) {
    const double coverage = reference.coverage[pixel];
    addCoverage(sums, coverage, test.rgba[4 * pixel + 3] / 255.0);
    sums.flip += flip[pixel];
    addDifference(sums, coverage, &truth[3 * pixel], &own[3 * pixel]);
    if (coverage <= 0) continue;
    sums.ssim += ssim[pixel];
    addImpostor(sums, test, pixel);
  }
  return sums;
}

double psnrDb(double meanSquare) {
  return meanSquare > 0 ? std::min(kMaxPsnrDb, 10 * std::log10(255.0 * 255.0 / meanSquare)) : kMaxPsnrDb;
}

}  // namespace

Metrics measure(const ReferenceImage& reference, const TestImage& test, const Colour& background,
                std::vector<float>* flipMap) {
  const size_t pixels = static_cast<size_t>(reference.width) * static_cast<size_t>(reference.height);
  FARCELL_CHECK_EQ(reference.width, test.width);
  FARCELL_CHECK_EQ(reference.height, test.height);
  FARCELL_CHECK_EQ(reference.coverage.size(), pixels);
  FARCELL_CHECK_EQ(reference.rgb.size(), 3 * pixels);
  FARCELL_CHECK_EQ(test.rgba.size(), 4 * pixels);
  FARCELL_CHECK(test.impostorCoverage.empty() || test.impostorCoverage.size() == pixels);

  std::vector<float> flip;
  Sums sums = sumUp(reference, test, background, flip);
  if (flipMap) *flipMap = std::move(flip);
  Metrics metrics;
  metrics.foregroundPixels = sums.largest.size();
  metrics.rectanglePixels = foregroundRectangle(reference).pixels();
  const auto foreground = static_cast<double>(metrics.foregroundPixels);
  metrics.paperErrorSum = sums.absolute;
  metrics.paperError = ratio(sums.absolute, static_cast<double>(metrics.rectanglePixels));
  metrics.mae = ratio(sums.foreground, 3 * foreground);
  metrics.psnr = psnrDb(ratio(sums.squares, 3 * foreground));
  metrics.ssim = foreground > 0 ? sums.ssim / foreground : 1;
  metrics.flip = ratio(sums.flip, static_cast<double>(pixels));
  metrics.p95 = percentile(sums.largest, 0.95);
  metrics.p99 = percentile(sums.largest, 0.99);
  metrics.holeRate = ratio(static_cast<double>(sums.holes), static_cast<double>(sums.solid));
  metrics.leakRate = ratio(static_cast<double>(sums.leaks), foreground);
  metrics.coverageBias = sums.referenceCoverage > 0 ? sums.coverage / sums.referenceCoverage - 1 : 0;
  metrics.impostorShare = ratio(sums.impostor, static_cast<double>(sums.drawn));
  metrics.silhouetteShare = foreground > 0 ? ratio(sums.silhouette, sums.absolute) : 0;
  metrics.interiorShare = foreground > 0 ? ratio(sums.interior, sums.absolute) : 0;
  return metrics;
}

double paperError(const ReferenceImage& reference, std::span<const float> truth, std::span<const float> own) {
  FARCELL_CHECK(truth.size() == own.size() && truth.size() == 3 * reference.coverage.size());
  double sum = 0;
  for (size_t i = 0; i < own.size(); ++i) sum += std::abs(own[i] - truth[i]);
  return ratio(sum, static_cast<double>(foregroundRectangle(reference).pixels()));
}

}  // namespace farcell
