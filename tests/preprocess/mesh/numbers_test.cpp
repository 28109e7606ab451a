#include <gtest/gtest.h>

#include <clocale>
#include <cmath>
#include <random>

#include "preprocess/mesh/number_text.h"
#include "preprocess/mesh/zero_area.h"

namespace farcell {
namespace {

TEST(NumberText, ReadsWhatMeshFilesHold) {
  double value = 0;
  for (const auto& [text, expected] : {std::pair{"1", 1.0},
                                       {"+1.5", 1.5},
                                       {"-0", -0.0},
                                       {".5", 0.5},
                                       {"1.", 1.0},
                                       {"1e3", 1000.0},
                                       {"-1E-3", -0.001},
                                       {"500000.001", 500000.001},
                                       {"1e-400", 0.0},
                                       {"1e400", double(INFINITY)},
                                       {"-1e400", -double(INFINITY)},
                                       {"inf", double(INFINITY)},
                                       {"-Infinity", -double(INFINITY)}}) {
    ASSERT_TRUE(parseNumber(text, value)) << text;
    EXPECT_EQ(value, expected) << text;
  }
  for (const char* text : {"nan", "-NaN", "1.#QNAN", "-1.#IND"}) {
    ASSERT_TRUE(parseNumber(text, value)) << text;
    EXPECT_TRUE(std::isnan(value)) << text;
  }
  for (const char* text : {"", "+", "-", "+-1", "++1", "1x", "1,5", "0x10", " 1", "e5", "."})
    EXPECT_FALSE(parseNumber(text, value)) << text;
}

TEST(NumberText, TellsTooSmallFromTooLarge) {
  double value = 1;
  const std::string tiny = "0." + std::string(400, '0') + "1";
  ASSERT_TRUE(parseNumber(tiny, value));
  EXPECT_EQ(value, 0);
  ASSERT_TRUE(parseNumber(std::string(400, '9'), value));
  EXPECT_EQ(value, INFINITY);
  float narrow = 1;
  ASSERT_TRUE(parseNumber("1e-60", narrow));
  EXPECT_EQ(narrow, 0);
}

TEST(NumberText, DoesNotCareForTheLocale) {
  const char* changed = std::setlocale(LC_NUMERIC, "de_DE.UTF-8");
  double value = 0;
  EXPECT_TRUE(parseNumber("1.5", value));
  EXPECT_EQ(value, 1.5);
  if (changed) std::setlocale(LC_NUMERIC, "C");
}

TEST(NumberText, RefusesWholeNumbersThatAreNone) {
  int64_t value = 0;
  EXPECT_TRUE(parseInteger("+12", value));
  EXPECT_EQ(value, 12);
  EXPECT_TRUE(parseInteger("-9223372036854775808", value));
  for (const char* text : {"", "1.0", "9223372036854775808", "1e3", "--1"})
    EXPECT_FALSE(parseInteger(text, value)) << text;
}

using Corners = std::array<glm::dvec3, 3>;

Corners scaledBy(const Corners& corners, double factor) {
  return {corners[0] * factor, corners[1] * factor, corners[2] * factor};
}

TEST(ZeroArea, IsScaleFree) {
  const Corners sliver = {glm::dvec3(0, 0, 0), glm::dvec3(1, 0, 0), glm::dvec3(0.5, 1e-14, 0)};
  const Corners line = {glm::dvec3(1, 2, 3), glm::dvec3(2, 4, 6), glm::dvec3(4, 8, 12)};
  for (int exponent = -1000; exponent <= 1000; exponent += 50) {
    const double factor = std::ldexp(1.0, exponent);
    EXPECT_FALSE(hasZeroArea(scaledBy(sliver, factor))) << exponent;
    EXPECT_TRUE(hasZeroArea(scaledBy(line, factor))) << exponent;
  }
}

TEST(ZeroArea, FindsEqualCorners) {
  const glm::dvec3 a(0.1, 0.2, 0.3);
  const glm::dvec3 b(5, -7, 1e-9);
  EXPECT_TRUE(hasZeroArea({a, a, b}));
  EXPECT_TRUE(hasZeroArea({a, b, a}));
  EXPECT_TRUE(hasZeroArea({b, a, a}));
  EXPECT_TRUE(hasZeroArea({a, a, a}));
}

TEST(ZeroArea, KeepsSliversWhoseProductsRoundAlike) {
  // (1+e)(1-e) and 1*1 round to the same double, but differ by e^2.
  const double e = std::ldexp(1.0, -30);
  EXPECT_FALSE(hasZeroArea({glm::dvec3(0), glm::dvec3(1 + e, 1, 0), glm::dvec3(1, 1 - e, 0)}));
  EXPECT_TRUE(hasZeroArea({glm::dvec3(0), glm::dvec3(1 + e, 1, 0), glm::dvec3(2 + 2 * e, 2, 0)}));
}

TEST(ZeroArea, AgreesWithWholeNumbersWhereProductsUnderflow) {
  constexpr uint32_t kSeed = 5;
  SCOPED_TRACE(kSeed);
  std::mt19937 random(kSeed);
  int zero = 0;
  for (int round = 0; round < 200000; ++round) {
    std::array<std::array<int64_t, 3>, 3> p{};
    for (auto& point : p)
      for (int64_t& value : point) value = static_cast<int64_t>(random() % 4);
    const auto e = [&](size_t corner, size_t axis) { return p[corner][axis] - p[0][axis]; };
    bool expected = true;
    for (size_t i = 0; i < 3; ++i) expected &= e(1, i) * e(2, (i + 1) % 3) == e(1, (i + 1) % 3) * e(2, i);
    Corners corners;
    for (size_t i = 0; i < 3; ++i)
      corners[i] = glm::dvec3(double(p[i][0]), double(p[i][1]), double(p[i][2])) * std::ldexp(1.0, -700);
    zero += expected;
    ASSERT_EQ(hasZeroArea(corners), expected);
  }
  EXPECT_GT(zero, 1000);
}

TEST(ZeroArea, SurvivesTheLargestNumbers) {
  const double huge = 1.7e308;
  EXPECT_FALSE(hasZeroArea({glm::dvec3(-huge, 0, 0), glm::dvec3(huge, 0, 0), glm::dvec3(0, huge, 0)}));
  EXPECT_TRUE(hasZeroArea({glm::dvec3(-huge, 0, 0), glm::dvec3(huge, 0, 0), glm::dvec3(0, 0, 0)}));
  const double tiny = 5e-324;
  EXPECT_FALSE(hasZeroArea({glm::dvec3(0), glm::dvec3(tiny, 0, 0), glm::dvec3(0, tiny, 0)}));
}

}  // namespace
}  // namespace farcell
