#include "runtime/selection/loss.h"

#include <algorithm>
#include <cmath>

namespace farcell {

double impostorLoss(const CellRecord&, double texelPixels) {
  return std::min(0.2 + std::clamp(texelPixels - 0.35, 0.0, 0.35) + 0.3 * std::max(texelPixels - 0.7, 0.0), 4.0);
}

double meshLoss(const CellRecord&, double errorPixels, double trianglesPerPixel) {
  return std::clamp(0.2 + 0.05 * std::log2(trianglesPerPixel), 0.1, 0.42) + 0.25 * errorPixels;
}

}  // namespace farcell
