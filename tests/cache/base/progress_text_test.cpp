#include "cache/base/progress_text.h"

#include <gtest/gtest.h>

#include <array>

namespace farcell {
namespace {

const StageProgress kBake{"bake", "views", 6'300, 14'000, 5.1};
const std::array<BudgetUse, 3> kBudgets = {
    BudgetUse{"memory", 812'000'000, 2'147'483'648}, {"disk", 3'100'000'000, 0}, {"pack", 120'000'000, 1'000'000'000}};

TEST(ProgressText, TheBarFillsTheWidthItIsGiven) {
  EXPECT_EQ(progressBar(kBake, {}, 79),
            "bake        45% [###############....................] 1.24k views/s, 6.2 s left");
  EXPECT_EQ(progressBar(kBake, kBudgets, 100),
            "bake        45% [#########...........] 1.24k views/s, 6.2 s left; memory 37%, disk 3.10 GB, pack 12%");
  EXPECT_EQ(progressBar(kBake, kBudgets, 80),
            "bake        45% 1.24k views/s, 6.2 s left; memory 37%, disk 3.10 GB, pack 12%");
  for (size_t columns = 0; columns < 200; ++columns) {
    const std::string bar = progressBar(kBake, kBudgets, columns);
    EXPECT_LE(bar.size(), columns);
    EXPECT_EQ(bar.find_first_of("\n\r\t\x1b"), std::string::npos);
  }
}

TEST(ProgressText, TheBarIsEmptyAtFirstAndFullAtLastWhateverWasCounted) {
  EXPECT_EQ(progressBar({"read", "B", 0, 10, 0}, {}, 40), "read         0% [................] 0 B/s");
  EXPECT_EQ(progressBar({"read", "B", 25, 10, 0.5}, {}, 50), "read       100% [#############] 50 B/s, 0.0 s left");
  EXPECT_EQ(progressBar({"read", "B", 0, 0, 1}, {}, 40), "read       100% [################] 0 B/s");
}

TEST(ProgressText, ALineSaysCountsAndAmounts) {
  EXPECT_EQ(progressLine(kBake, {}, false), "bake        45%         6300/14000 views, 1.24k/s, 6.2 s left");
  EXPECT_EQ(progressLine(kBake, std::span(kBudgets).first(2), false),
            "bake        45%         6300/14000 views, 1.24k/s, 6.2 s left; memory 812 MB of 2.15 GB, disk 3.10 GB");
  EXPECT_EQ(progressLine(kBake, {}, true), "bake        45%         6300/14000 views, 1.24k/s, 5.1 s");
}

TEST(ProgressText, JsonHasTheFieldsThatAreKnown) {
  EXPECT_EQ(progressJson("advance", kBake, std::span(kBudgets).first(2)),
            R"({"event":"advance","stage":"bake","unit":"views","done":6300,"total":14000,"seconds":5.100,)"
            R"("rate":1235.3,"secondsLeft":6.2,"budgets":[{"name":"memory","used":812000000,"limit":2147483648},)"
            R"({"name":"disk","used":3100000000}]})");
  EXPECT_EQ(
      progressJson("begin", {"re\"ad\n", "B", 0, 10, 0}, {}),
      R"({"event":"begin","stage":"read","unit":"B","done":0,"total":10,"seconds":0.000,"rate":0.0,"budgets":[]})");
}

TEST(ProgressText, CountsHaveThreeDigits) {
  EXPECT_EQ(countText(0), "0");
  EXPECT_EQ(countText(0.25), "0.2");
  EXPECT_EQ(countText(12), "12");
  EXPECT_EQ(countText(999), "999");
  EXPECT_EQ(countText(999.6), "1.00k");
  EXPECT_EQ(countText(12'345), "12.3k");
  EXPECT_EQ(countText(999'600), "1.00M");
  EXPECT_EQ(countText(25.6e6), "25.6M");
  EXPECT_EQ(countText(1e17), "100000T");
}

TEST(ProgressText, DurationsAreSecondsThenClockTimes) {
  EXPECT_EQ(durationText(0.04), "0.0 s");
  EXPECT_EQ(durationText(9.94), "9.9 s");
  EXPECT_EQ(durationText(9.96), "10 s");
  EXPECT_EQ(durationText(59.4), "59 s");
  EXPECT_EQ(durationText(59.6), "1:00");
  EXPECT_EQ(durationText(83), "1:23");
  EXPECT_EQ(durationText(7'390), "2:03:10");
  EXPECT_EQ(durationText(1e300), "ages");
}

TEST(ProgressText, BytesAreInDecimalUnits) {
  EXPECT_EQ(bytesText(0), "0 B");
  EXPECT_EQ(bytesText(999), "999 B");
  EXPECT_EQ(bytesText(1'000), "1.00 kB");
  EXPECT_EQ(bytesText(2'147'483'648), "2.15 GB");
}

}  // namespace
}  // namespace farcell
