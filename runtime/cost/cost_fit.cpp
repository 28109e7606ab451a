#include "runtime/cost/cost_fit.h"

#include <algorithm>
#include <array>
#include <vector>

namespace farcell {
namespace {

constexpr size_t kCosts = 5;
constexpr int kSweeps = 2000;

using Row = std::array<double, kCosts>;

Row rowOf(const FrameWork& work) {
  return {work.picturePixels, work.triangles, work.meshPixels, work.impostors, work.impostorPixels};
}

}  // namespace

DrawCosts fitCosts(std::span<const TimedFrame> frames) {
  // Rows relative to their time: what is to be explained is 1 for each.
  std::vector<Row> rows;
  for (const TimedFrame& frame : frames) {
    rows.push_back(rowOf(frame.work));
    for (double& amount : rows.back()) amount /= frame.ms;
  }
  Row costs{};
  for (int sweep = 0; sweep < kSweeps; ++sweep)
    for (size_t c = 0; c < kCosts; ++c) {
      double along = 0, square = 0;
      for (const Row& row : rows) {
        double rest = 1;
        for (size_t i = 0; i < kCosts; ++i) rest -= i == c ? 0 : costs[i] * row[i];
        along += row[c] * rest;
        square += row[c] * row[c];
      }
      costs[c] = square > 0 ? std::max(0.0, along / square) : 0;
    }
  return {costs[0], costs[1], costs[2], costs[3], costs[4]};
}

}  // namespace farcell
