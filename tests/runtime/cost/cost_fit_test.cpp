#include "runtime/cost/cost_fit.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <random>
#include <vector>

namespace farcell {
namespace {

TEST(CostFit, findsTheCostsThatMadeTheTimes) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> part(0, 1);
  for (int round = 0; round < 20; ++round) {
    SCOPED_TRACE(fmt::format("seed 7, round {}", round));
    const DrawCosts truth = {1e-6 * part(random), 3e-4 * part(random), 1e-6 * part(random), 0.1 * part(random),
                             1e-4 * part(random)};
    std::vector<TimedFrame> frames;
    for (int i = 0; i < 12; ++i) {
      const FrameWork work = {1e5 * part(random), 1e5 * part(random), 1e6 * part(random), 50 * part(random),
                              1e5 * part(random)};
      frames.push_back({work, expectedMs(truth, work)});
    }
    const DrawCosts found = fitCosts(frames);
    for (const TimedFrame& frame : frames) EXPECT_NEAR(expectedMs(found, frame.work), frame.ms, 0.02 * frame.ms);
    EXPECT_NEAR(found.triangleMs, truth.triangleMs, 0.1 * truth.triangleMs + 1e-6);
  }
}

TEST(CostFit, noCostIsNegativeAndWhatNoFrameHasCostsNothing) {
  // More triangles in less time, without impostors.
  const std::vector<TimedFrame> frames = {{{100, 10, 0, 0, 0}, 10}, {{100, 20, 0, 0, 0}, 5}, {{200, 40, 0, 0, 0}, 4}};
  const DrawCosts costs = fitCosts(frames);
  EXPECT_GE(costs.picturePixelMs, 0);
  EXPECT_GE(costs.triangleMs, 0);
  EXPECT_GT(costs.picturePixelMs + costs.triangleMs, 0);
  EXPECT_EQ(costs.meshPixelMs, 0);
  EXPECT_EQ(costs.impostorMs, 0);
  EXPECT_EQ(costs.impostorPixelMs, 0);
}

}  // namespace
}  // namespace farcell
