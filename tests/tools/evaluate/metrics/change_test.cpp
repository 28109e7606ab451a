#include "tools/evaluate/metrics/change.h"

#include <gtest/gtest.h>

#include <random>

namespace farcell {
namespace {

// Two pixels. The picture's first pixel rises by 10, 20, 30 where the reference's rises by 10, 0, 40; its second stays
// where the reference's red falls by 60.
TEST(Change, IsTheDifferenceOfTheChangesByHand) {
  const std::vector<float> ownBefore = {100, 100, 100, 50, 50, 50}, ownNow = {110, 120, 130, 50, 50, 50};
  const std::vector<float> truthBefore = {0, 0, 0, 90, 0, 0}, truthNow = {10, 0, 40, 30, 0, 0};
  std::vector<float> map;
  const Change change = measureChange({ownBefore, truthBefore}, {ownNow, truthNow}, &map);
  EXPECT_DOUBLE_EQ(change.own, (10 + 20 + 30) / 6.0);
  EXPECT_DOUBLE_EQ(change.reference, (10 + 0 + 40 + 60) / 6.0);
  EXPECT_DOUBLE_EQ(change.flicker, (0 + 20 + 10 + 60) / 6.0);
  EXPECT_EQ(map, (std::vector<float>{0, 20, 10, 60, 0, 0}));
}

TEST(Change, OfAConstantErrorIsNoFlicker) {
  std::mt19937 random(1);
  std::vector<float> truthBefore(300), truthNow(300), ownBefore(300), ownNow(300);
  for (size_t i = 0; i < truthNow.size(); ++i) {
    const auto error = static_cast<float>(random() % 50);
    truthBefore[i] = static_cast<float>(random() % 200);
    truthNow[i] = static_cast<float>(random() % 200);
    ownBefore[i] = truthBefore[i] + error;
    ownNow[i] = truthNow[i] + error;
  }
  const Change change = measureChange({ownBefore, truthBefore}, {ownNow, truthNow});
  EXPECT_EQ(change.flicker, 0);
  EXPECT_EQ(change.own, change.reference);
  EXPECT_GT(change.own, 10);
}

}  // namespace
}  // namespace farcell
