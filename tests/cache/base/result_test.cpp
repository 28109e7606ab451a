#include "cache/base/result.h"

#include <gtest/gtest.h>

#include <memory>

#include "cache/base/check.h"

namespace farcell {
namespace {

Result<int> half(int value) {
  if (value % 2 != 0) return fail(ErrorKind::invalidArgument, "{}: expected an even number", value);
  return value / 2;
}

Result<> mustBeEven(int value, int& reached) {
  FARCELL_TRY(half(value));
  ++reached;
  return {};
}

Result<int> quarter(int value) {
  FARCELL_ASSIGN(const int first, half(value));
  FARCELL_ASSIGN(const int second, half(first));
  return second;
}

Result<std::unique_ptr<int>> boxed(int value) {
  FARCELL_ASSIGN(const int halved, half(value));
  return std::make_unique<int>(halved);
}

Result<int> unboxed(int value) {
  FARCELL_ASSIGN(const std::unique_ptr<int> box, boxed(value));
  return *box;
}

TEST(Result, AssignGivesTheValueOrReturnsTheFirstError) {
  EXPECT_EQ(quarter(12).value(), 3);
  EXPECT_EQ(quarter(6).error().message, "3: expected an even number");
  EXPECT_EQ(quarter(5).error().message, "5: expected an even number");
  EXPECT_EQ(quarter(5).error().kind, ErrorKind::invalidArgument);
}

TEST(Result, AssignMovesWhatCannotBeCopied) {
  EXPECT_EQ(unboxed(8).value(), 4);
  EXPECT_FALSE(unboxed(7));
}

TEST(Result, TryGoesOnOnlyAfterSuccess) {
  int reached = 0;
  EXPECT_TRUE(mustBeEven(2, reached));
  EXPECT_EQ(reached, 1);
  EXPECT_FALSE(mustBeEven(3, reached));
  EXPECT_EQ(reached, 1);
}

TEST(Result, CorruptNamesPathOffsetExpectedAndFound) {
  const Result<> result = corrupt("city.ply", 1234, "'end_header'", "end of file");
  EXPECT_EQ(result.error().kind, ErrorKind::corrupt);
  EXPECT_EQ(result.error().message, "city.ply: offset 1234: expected 'end_header', found end of file");
}

TEST(CheckDeathTest, ABrokenPromiseStopsTheProgramAndPrintsBothValues) {
  const int two = 2;
  EXPECT_DEATH(FARCELL_CHECK_EQ(two, 3), "result_test.cpp:.* broken promise: two == 3 \\(2 against 3\\)");
  EXPECT_DEATH(FARCELL_CHECK(two > 3), "broken promise: two > 3");
  FARCELL_CHECK(two == 2);
  FARCELL_CHECK_EQ(two, 2);
}

}  // namespace
}  // namespace farcell
