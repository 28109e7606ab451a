#include "tools/evaluate/metrics/convolution.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace farcell {
namespace {

// The innermost loop of all filters: over a row, so that the compiler makes vectors of it.
void addWeighted(double* to, const double* from, double weight, int count) {
  for (int i = 0; i < count; ++i) to[i] += weight * from[i];
}

Plane emptyLike(const Plane& plane) { return {plane.width, plane.height, std::vector<double>(plane.values.size())}; }

}  // namespace

Kernel gaussian(double sigma, int radius) {
  Kernel kernel;
  for (int x = -radius; x <= radius; ++x) kernel.push_back(std::exp(-x * x / (2 * sigma * sigma)));
  return kernel;
}

Kernel normalised(Kernel kernel) {
  double sum = 0;
  for (const double weight : kernel) sum += weight;
  for (double& weight : kernel) weight /= sum;
  return kernel;
}

Plane alongRows(const Plane& plane, const Kernel& kernel) {
  Plane result = emptyLike(plane);
  const auto width = static_cast<size_t>(plane.width), radius = kernel.size() / 2;
  std::vector<double> padded(width + 2 * radius);
  for (size_t row = 0; row < plane.values.size(); row += width) {
    const double* from = &plane.values[row];
    std::fill_n(padded.begin(), radius, from[0]);
    std::copy_n(from, width, padded.begin() + static_cast<std::ptrdiff_t>(radius));
    std::fill_n(padded.end() - static_cast<std::ptrdiff_t>(radius), radius, from[width - 1]);
    for (size_t k = 0; k < kernel.size(); ++k) addWeighted(&result.values[row], &padded[k], kernel[k], plane.width);
  }
  return result;
}

Plane alongColumns(const Plane& plane, const Kernel& kernel) {
  Plane result = emptyLike(plane);
  const int radius = static_cast<int>(kernel.size() / 2);
  for (int y = 0; y < plane.height; ++y)
    for (int k = -radius; k <= radius; ++k) {
      const int from = std::clamp(y + k, 0, plane.height - 1);
      addWeighted(&result.values[static_cast<size_t>(y) * plane.width],
                  &plane.values[static_cast<size_t>(from) * plane.width], kernel[static_cast<size_t>(k + radius)],
                  plane.width);
    }
  return result;
}

}  // namespace farcell
