#include "tools/evaluate/plan/suns.h"

#include <cmath>
#include <numbers>

namespace farcell {

std::vector<Sun> skySuns(int count) {
  constexpr double kGoldenRad = 2 * std::numbers::pi * (1 - 1 / std::numbers::phi);
  std::vector<Sun> suns;
  for (int i = 0; i < count; ++i)
    suns.push_back({std::remainder(i * kGoldenRad, 2 * std::numbers::pi), std::asin((i + 0.5) / count)});
  return suns;
}

}  // namespace farcell
