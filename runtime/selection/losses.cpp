#include "runtime/selection/losses.h"

#include <algorithm>

namespace farcell {

double impostorLoss(const CellRecord& cell, double texelPixels) {
  if (cell.errors.knows(ErrorWay::depthCorrected))
    return expectedError(cell.errors, ErrorWay::depthCorrected, texelPixels);
  return std::min(0.1 + 0.4 * texelPixels, 4.0);
}

double meshLoss(const CellRecord& cell, double texelPixels, double errorPixels) {
  if (cell.errors.knows(ErrorWay::mesh)) return expectedError(cell.errors, ErrorWay::mesh, texelPixels);
  return 0.4 + 0.25 * errorPixels;
}

}  // namespace farcell
