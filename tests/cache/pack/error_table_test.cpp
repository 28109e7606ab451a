#include "cache/pack/error_table.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace farcell {
namespace {

ErrorTable meshTable(std::array<double, kErrorScales> errors) {
  ErrorTable table;
  for (size_t i = 0; i < kErrorScales; ++i) table.codes[0][i] = codeFromError(errors[i]);
  return table;
}

TEST(ErrorTable, codesAreWithinTheirStepAndNeverUnknown) {
  EXPECT_EQ(errorFromCode(codeFromError(1)), 1);
  for (double error = 0.002; error < 50; error *= 1.07)
    EXPECT_NEAR(errorFromCode(codeFromError(error)) / error, 1, 0.0221) << error;
  for (const double error : {0.0, -1.0, 1e-30, 1e30, std::numeric_limits<double>::infinity()})
    EXPECT_GT(codeFromError(error), 0);
  for (int code = 2; code < 256; ++code)
    EXPECT_GT(errorFromCode(static_cast<uint8_t>(code)), errorFromCode(static_cast<uint8_t>(code - 1)));
}

TEST(ErrorTable, knowsWhatIsThere) {
  const ErrorTable table = meshTable({1, 1, 1, 1});
  EXPECT_TRUE(table.knows(ErrorWay::mesh));
  EXPECT_FALSE(table.knows(ErrorWay::depthCorrected));
  EXPECT_FALSE(ErrorTable().knows(ErrorWay::mesh));
}

TEST(ErrorTable, isReadOnStraightLinesOfLogarithms) {
  const ErrorTable table = meshTable({0.25, 0.5, 2, 4});
  for (size_t i = 0; i < kErrorScales; ++i)
    EXPECT_EQ(expectedError(table, ErrorWay::mesh, kErrorTexelPixels[i]), errorFromCode(table.codes[0][i]));
  EXPECT_NEAR(expectedError(table, ErrorWay::mesh, std::sqrt(0.5)), 1, 1e-9) << "half way between .5 and 2";
  EXPECT_NEAR(expectedError(table, ErrorWay::mesh, 4), 8, 1e-9) << "on like between 1 and 2 pixels";
  EXPECT_NEAR(expectedError(table, ErrorWay::mesh, 16), 32, 1e-9);
  EXPECT_EQ(expectedError(table, ErrorWay::mesh, std::numeric_limits<double>::infinity()),
            expectedError(table, ErrorWay::mesh, 16));
  EXPECT_EQ(expectedError(table, ErrorWay::mesh, 1e-9), expectedError(table, ErrorWay::mesh, 0.25));
}

}  // namespace
}  // namespace farcell
