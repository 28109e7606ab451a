#include "tools/evaluate/plan/equal_time.h"

#include <gtest/gtest.h>

namespace farcell {
namespace {

TEST(EqualTimeSetting, IsFoundOnAFallingCurve) {
  int measured = 0;
  const auto time = [&](double setting) -> Result<double> {
    ++measured;
    return 10 / setting;
  };
  // 10 / setting = 4 at 2.5.
  const double found = settingOfTime(0.01, 100, 12, 4, time).value();
  EXPECT_GE(found, 2.5) << "never slower";
  EXPECT_LT(found, 2.5 * 1.01);
  EXPECT_EQ(measured, 1 + 12);
}

TEST(EqualTimeSetting, IsTheFastestWhereNoneIsFastEnough) {
  EXPECT_EQ(settingOfTime(0.01, 100, 9, 1, [](double) -> Result<double> { return 2; }).value(), 100);
}

TEST(EqualTimeSetting, NearsTheLeastWhereAllAreFastEnough) {
  EXPECT_LT(settingOfTime(0.01, 100, 20, 3, [](double) -> Result<double> { return 2; }).value(), 0.0101);
}

TEST(EqualTimeSetting, EndsWithAFailure) {
  const auto failing = [](double setting) -> Result<double> {
    if (setting < 50) return fail(ErrorKind::io, "gone");
    return 1;
  };
  const auto found = settingOfTime(0.01, 100, 9, 3, failing);
  ASSERT_FALSE(found);
  EXPECT_EQ(found.error().message, "gone");
}

}  // namespace
}  // namespace farcell
