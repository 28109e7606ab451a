// What an error that views may have buys, and how much of it their texels come to have.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "cache/pack/pages.h"

namespace farcell {

enum class NearWay : uint8_t {
  insidePrediction,  // as built: residuals are multiples of 2 maxError + 1
  beforePrediction,  // channels are rounded to such multiples, then coded without loss
};

struct NearTotals {
  int maxError;
  NearWay way;
  uint64_t bytes = 0;
  std::array<uint64_t, 5> texels = {};  // covered, or of known depth; of R, G, B, A, depth
  std::array<int, 5> worst = {};
  std::array<uint64_t, 5> squares = {};  // of their errors
  double encodeSeconds = 0;
  double decodeSeconds = 0;
};
std::vector<NearTotals> nearWays();
void addNear(const ViewImage& view, std::vector<NearTotals>& totals);

}  // namespace farcell
