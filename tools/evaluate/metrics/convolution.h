// Separable filters over one channel of a picture; at the border, the outermost pixel goes on.
#pragma once

#include <vector>

namespace farcell {

struct Plane {
  int width = 0;
  int height = 0;
  std::vector<double> values;  // 1 a pixel, row 0 at the top
};

using Kernel = std::vector<double>;  // 2 * radius + 1 weights

// exp(-x^2 / (2 sigma^2)) for whole x from -radius to radius.
Kernel gaussian(double sigma, int radius);
// The same with weights that sum to 1.
Kernel normalised(Kernel kernel);

// Each value becomes the sum of weights[k] * the value k - radius to its right, or below it.
Plane alongRows(const Plane& plane, const Kernel& kernel);
Plane alongColumns(const Plane& plane, const Kernel& kernel);

}  // namespace farcell
