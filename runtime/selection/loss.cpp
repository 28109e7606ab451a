#include "runtime/selection/loss.h"

#include <algorithm>
#include <cmath>

namespace farcell {

double impostorLoss(const CellRecord& cell, double texelPixels) {
  if (cell.errors.knows(ErrorWay::depthCorrected))
    return expectedError(cell.errors, ErrorWay::depthCorrected, texelPixels);
  return std::min(0.2 + std::clamp(texelPixels - 0.35, 0.0, 0.35) + 0.3 * std::max(texelPixels - 0.7, 0.0), 4.0);
}

double meshLoss(const CellRecord& cell, double texelPixels, double errorPixels, double trianglesPerPixel) {
  if (cell.errors.knows(ErrorWay::mesh)) return expectedError(cell.errors, ErrorWay::mesh, texelPixels);
  return std::clamp(0.2 + 0.05 * std::log2(trianglesPerPixel), 0.1, 0.42) + 0.25 * errorPixels;
}

}  // namespace farcell
