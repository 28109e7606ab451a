#include "tools/report/build_summary.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <sstream>

namespace farcell {
namespace {

BuildSummary statue() {
  BuildSummary summary;
  summary.triangles = 25'600'000;
  summary.leaves = 712;
  summary.innerCells = 214;
  summary.viewsKept = 31'020;
  summary.viewsBaked = 38'892;
  summary.stages = {{"read", 8.314, 15.2, 25'600'000, "triangles", 1'843'200'000},
                    {"bake", 40.5, {}, 38'892, "views", 300'120'000},
                    {"finish", 0.004, 0.0, 0, "", {}}};
  summary.seconds = 61.25;
  summary.cpuSeconds = 99.5;
  summary.parts = {{"geometry", 310'000'000}, {"impostors", 290'500'000}};
  summary.packBytes = 602'000'000;
  summary.packBudget = 4'000'000'000;
  summary.peakRssBytes = 812'000'000;
  summary.memoryLimit = 2'147'483'648;
  summary.leftOut = {{"views", "empty", 7'872, 1'200'000}, {"triangles", "zero area", 3, {}}};
  return summary;
}

TEST(BuildSummary, IsTheseTables) {
  EXPECT_EQ(buildSummaryText(statue()), R"(25600000 triangles, 712 + 214 inner cells, 31020 of 38892 views kept

stage          seconds     CPU s                  rate       bytes
read              8.31     15.20     3.08M triangles/s     1.84 GB
bake             40.50         -           960 views/s      300 MB
finish            0.00      0.00                     -           -
total            61.25     99.50      418k triangles/s      602 MB

pack             bytes     share      bytes a triangle
geometry        310 MB     51.5%                 12.11
impostors       290 MB     48.3%                 11.35
other          1.50 MB      0.2%                  0.06

left out         count bytes saved  why
views             7872     1.20 MB  empty
triangles            3           -  zero area

pack 602 MB of 4.00 GB; peak memory 812 MB of 2.15 GB
)");
}

TEST(BuildSummary, OfAnEmptyBuildSaysSoWithoutDividingByNothing) {
  const std::string text = buildSummaryText({});
  EXPECT_EQ(text.find("left out"), std::string::npos);
  EXPECT_EQ(text.find("nan"), std::string::npos) << text;
  EXPECT_EQ(text.find("inf"), std::string::npos) << text;
  EXPECT_NE(text.find("pack 0 B; peak memory 0 B\n"), std::string::npos) << text;
}

TEST(BuildSummary, FitsEightyColumnsWhateverTheNumbers) {
  BuildSummary summary = statue();
  summary.seconds = 999'999;
  summary.cpuSeconds = 9'999'999;
  summary.stages[0].seconds = 1e-9;
  summary.packBytes = uint64_t{1} << 60;
  summary.parts[0].bytes = uint64_t{1} << 59;
  std::istringstream lines(buildSummaryText(summary));
  for (std::string line; std::getline(lines, line);) EXPECT_LE(line.size(), 80u) << line;
}

}  // namespace
}  // namespace farcell
