#include "preprocess/measure/regression.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace farcell {
namespace {

struct Samples {
  std::vector<Features> features;
  std::vector<double> values;
};

double truth(const Features& f) { return 2 + 3 * f[0] - 0.5 * f[1]; }

// Of a line and a little noise; the last feature is the same everywhere.
Samples samples(uint32_t seed, int count, double noise) {
  std::mt19937 random(seed);
  std::normal_distribution<double> normal;
  Samples result;
  for (int i = 0; i < count; ++i) {
    Features f;
    for (size_t j = 0; j < kFeatures; ++j) f[j] = j + 1 == kFeatures ? 7 : normal(random) * (j == 1 ? 100 : 1);
    result.features.push_back(f);
    result.values.push_back(truth(f) + noise * normal(random));
  }
  return result;
}

TEST(Regression, findsALine) {
  const Samples s = samples(1, 400, 0.01);
  const Regression regression(s.features, s.values);
  const Samples other = samples(2, 50, 0);
  for (size_t i = 0; i < other.values.size(); ++i) EXPECT_NEAR(regression(other.features[i]), other.values[i], 1.5);
}

TEST(Regression, isHardlyMovedByAFewThatLie) {
  Samples s = samples(3, 60, 0.05);
  const Regression before(s.features, s.values);
  for (size_t i = 0; i < s.values.size(); i += 12) s.values[i] += 400;
  const Regression after(s.features, s.values);
  double mean = 0;
  for (const double value : s.values) mean += value / static_cast<double>(s.values.size());
  ASSERT_GT(mean, 30) << "what least squares would move by";
  for (const Features& f : samples(4, 50, 0).features) EXPECT_NEAR(after(f), before(f), 12);
}

TEST(Regression, ofOneOrOfTheSameIsThat) {
  const Features f{};
  EXPECT_NEAR(Regression(std::vector{f}, std::vector{5.0})(f), 5, 1e-12);
  EXPECT_NEAR(Regression(std::vector{f, f, f}, std::vector{5.0, 5.0, 5.0})({9, 9, 9}), 5, 1e-12);
}

TEST(Regression, doesNotGoFarBeyondWhatItSaw) {
  const Samples s = samples(5, 30, 0);
  const auto [low, high] = std::minmax_element(s.values.begin(), s.values.end());
  Features far{};
  far[1] = 1e9;
  const double value = Regression(s.features, s.values)(far);
  EXPECT_NEAR(value, *low - 0.5 * (*high - *low), 1e-9);
}

TEST(LeaveOneOut, doesNotKnowWhatItTells) {
  Samples s = samples(6, 40, 0.01);
  const std::vector<double> before = leaveOneOut(s.features, s.values);
  ASSERT_EQ(before.size(), s.values.size());
  s.values[7] = 1000;
  EXPECT_EQ(leaveOneOut(s.features, s.values)[7], before[7]);
  EXPECT_NE(Regression(s.features, s.values)(s.features[7]), before[7]);
}

}  // namespace
}  // namespace farcell
