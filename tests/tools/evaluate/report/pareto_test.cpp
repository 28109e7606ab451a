#include "tools/evaluate/report/pareto.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <random>

namespace farcell {
namespace {

std::vector<bool> bruteForce(const std::vector<ErrorAndTime>& points) {
  std::vector<bool> front;
  for (const ErrorAndTime& point : points)
    front.push_back(std::none_of(points.begin(), points.end(), [&](const ErrorAndTime& other) {
      return other.error <= point.error && other.ms <= point.ms && (other.error < point.error || other.ms < point.ms);
    }));
  return front;
}

TEST(ParetoFront, IsWhatNoOtherPointBeats) {
  EXPECT_EQ(paretoFront({}), std::vector<bool>());
  const std::vector<ErrorAndTime> points = {{1, 10}, {0.5, 20}, {0.6, 20}, {0.5, 30}, {2, 5}, {1, 10}, {2, 6}};
  EXPECT_EQ(paretoFront(points), (std::vector<bool>{true, true, false, false, true, true, false}));
  const double infinite = std::numeric_limits<double>::infinity();
  EXPECT_EQ(paretoFront(std::vector<ErrorAndTime>{{infinite, 3}, {0, 3}}), (std::vector<bool>{false, true}));
}

// Few different values: most points tie with others in one or both.
TEST(ParetoFront, EqualsBruteForceOnPointsWithTies) {
  for (uint32_t seed = 1; seed <= 2000; ++seed) {
    std::mt19937 random(seed);
    const size_t count = random() % 40, values = 1 + random() % 12;
    std::vector<ErrorAndTime> points;
    for (size_t i = 0; i < count; ++i)
      points.push_back({static_cast<double>(random() % values), static_cast<double>(random() % values)});
    ASSERT_EQ(paretoFront(points), bruteForce(points)) << "seed " << seed;
  }
}

}  // namespace
}  // namespace farcell
