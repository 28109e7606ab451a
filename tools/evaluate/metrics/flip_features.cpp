#include <cmath>

#include "tools/evaluate/metrics/flip_stages.h"
#include "tools/evaluate/metrics/metrics.h"

namespace farcell {
namespace {

constexpr double kWidthDegrees = 0.082;  // w: of the eye's edge detector, two standard deviations

// A derivative of a Gaussian: positive weights shall sum to 1, negative ones to -1.
Kernel balanced(Kernel kernel) {
  double positive = 0, negative = 0;
  for (const double weight : kernel) (weight > 0 ? positive : negative) += std::abs(weight);
  for (double& weight : kernel) weight /= weight > 0 ? positive : negative;
  return kernel;
}

// Length of the pair (derivative along x, derivative along y), each smoothed along the other axis. smoothRows: y,
// smoothed along x.
std::vector<double> response(const Plane& y, const Plane& smoothRows, const Kernel& smooth, const Kernel& derivative) {
  const Plane dx = alongColumns(alongRows(y, derivative), smooth);
  const Plane dy = alongColumns(smoothRows, derivative);
  std::vector<double> length(dx.values.size());
  for (size_t i = 0; i < length.size(); ++i)
    length[i] = std::sqrt(dx.values[i] * dx.values[i] + dy.values[i] * dy.values[i]);
  return length;
}

}  // namespace

Features detectFeatures(const Plane& y) {
  const double sigma = kWidthDegrees / 2 * kFlipPixelsPerDegree;
  const int radius = static_cast<int>(std::ceil(3 * sigma));
  const Kernel gauss = gaussian(sigma, radius), smooth = normalised(gauss);
  Kernel first = gauss, second = gauss;
  for (int x = -radius; x <= radius; ++x) {
    first[static_cast<size_t>(x + radius)] *= -x;
    second[static_cast<size_t>(x + radius)] *= x * x / (sigma * sigma) - 1;
  }
  const Plane smoothRows = alongRows(y, smooth);
  return {response(y, smoothRows, smooth, balanced(first)), response(y, smoothRows, smooth, balanced(second))};
}

}  // namespace farcell
