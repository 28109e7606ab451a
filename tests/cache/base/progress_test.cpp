#include "cache/base/progress.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <sstream>
#include <string>
#include <thread>
#include <vector>

#include "cache/base/parallel.h"
#include "cache/base/process.h"

namespace farcell {
namespace {

struct Output {
  std::string out;
  std::string err;
};

template <class Work>
Output captured(const Work& work) {
  testing::internal::CaptureStdout();
  testing::internal::CaptureStderr();
  work();
  return {testing::internal::GetCapturedStdout(), testing::internal::GetCapturedStderr()};
}

TEST(Progress, EnabledPrintsStageCountAndUnitOnStderrAndNothingOnStdout) {
  const Output output = captured([] {
    Progress progress(true);
    progress.begin("bake", 200, "views");
    for (int i = 0; i < 200; ++i) progress.advance();
    progress.begin("encode", 10, "pages");
    progress.advance(10);
    progress.end();
  });
  EXPECT_EQ(output.out, "");
  EXPECT_NE(output.err.find("bake"), std::string::npos) << output.err;
  EXPECT_NE(output.err.find("200/200 views"), std::string::npos) << output.err;
  EXPECT_NE(output.err.find("10/10 pages"), std::string::npos) << output.err;
  EXPECT_LT(output.err.find("bake"), output.err.find("encode"));
}

TEST(Progress, DisabledIsSilent) {
  const Output output = captured([] {
    Progress progress(false);
    progress.begin("bake", 2, "views");
    progress.advance(2);
    progress.end();
  });
  EXPECT_EQ(output.out + output.err, "");
}

TEST(Progress, WithoutATerminalALongStagePrintsAtMostALineForEachTenth) {
  const Output output = captured([] {
    Progress progress(true);
    progress.begin("bake", 30, "views");
    for (int i = 0; i < 30; ++i) {
      std::this_thread::sleep_for(std::chrono::milliseconds(25));
      progress.advance();
    }
    progress.end();
  });
  const auto lines = std::count(output.err.begin(), output.err.end(), '\n');
  EXPECT_GE(lines, 2) << output.err;
  EXPECT_LE(lines, 11) << output.err;
  EXPECT_EQ(output.err.find('\r'), std::string::npos);
}

TEST(Progress, AStageOfNothingAndAnEndWithoutAStageAreHarmless) {
  const Output output = captured([] {
    Progress progress(true);
    progress.end();
    progress.begin("read", 0, "triangles");
    progress.end();
    progress.end();
  });
  EXPECT_EQ(std::count(output.err.begin(), output.err.end(), '\n'), 1) << output.err;
}

TEST(Progress, AdvancedByManyThreadsCountsEveryUnit) {
  const Output output = captured([] {
    Progress progress(true);
    progress.begin("bake", 40'000, "views");
    parallelFor(40'000, 4, [&](size_t, int) { progress.advance(); });
    progress.end();
  });
  EXPECT_NE(output.err.find("40000/40000 views"), std::string::npos) << output.err;
}

TEST(Progress, JsonIsALineForEachEventAndDoneComesLast) {
  uint64_t asked = 0;
  const Output output = captured([&] {
    Progress progress(ProgressForm::json);
    progress.budget("memory", 1, [] { return uint64_t{1}; });
    progress.budget("memory", 1'000, [&] { return ++asked; });
    progress.begin("read", 10, "triangles");
    progress.advance(4);
    progress.begin("bake", 2, "views");
    progress.advance(2);
    progress.end();
  });
  std::istringstream lines(output.err);
  std::vector<std::string> heads;
  for (std::string line; std::getline(lines, line);
       heads.push_back(line.substr(0, line.find_first_of("0123456789")).substr(0, 31)))
    EXPECT_EQ(line.back(), '}');
  EXPECT_EQ(heads, (std::vector<std::string>{R"({"event":"begin","stage":"read")", R"({"event":"end","stage":"read",")",
                                             R"({"event":"begin","stage":"bake")", R"({"event":"end","stage":"bake",")",
                                             R"({"event":"done","seconds":)"}));
  EXPECT_EQ(asked, 4u);
  EXPECT_NE(output.err.find(R"("budgets":[{"name":"memory","used":4,"limit":1000}])"), std::string::npos) << output.err;
  EXPECT_EQ(output.out, "");
}

TEST(Progress, ABarIsDrawnOverItselfAndLeavesTheCursorOnANewLine) {
  const Output output = captured([] {
    Progress progress(ProgressForm::bar);
    progress.begin("bake", 3, "views");
    std::this_thread::sleep_for(std::chrono::milliseconds(260));
    progress.advance();
  });
  EXPECT_EQ(output.err.substr(0, 18), "\rbake        33% [");
  EXPECT_EQ(output.err.size(), 1 + 79 + 1u);
  EXPECT_EQ(output.err.back(), '\n');
}

TEST(Progress, FormsHaveNames) {
  EXPECT_EQ(progressFormNamed("none"), ProgressForm::none);
  EXPECT_EQ(progressFormNamed("auto"), ProgressForm::automatic);
  EXPECT_EQ(progressFormNamed("bar"), ProgressForm::bar);
  EXPECT_EQ(progressFormNamed("json"), ProgressForm::json);
  EXPECT_EQ(progressFormNamed("Bar"), std::nullopt);
}

TEST(Process, MemoryInUseIsBetweenWhatIsHeldAndThePeak) {
  const std::vector<char> touched(size_t{24} << 20, 1);
  EXPECT_GE(rssBytes(), touched.size());
  EXPECT_LE(rssBytes(), peakRssBytes() + (size_t{4} << 20));
}

TEST(Process, PeakMemoryCoversWhatWasTouchedAndCpuTimeGrows) {
  const uint64_t before = peakRssBytes();
  const double cpuBefore = processCpuSeconds();
  std::vector<char> touched(before + (size_t{32} << 20), 1);
  volatile double sum = 0;
  while (processCpuSeconds() - cpuBefore < 0.02) sum = sum + touched[touched.size() / 2];
  EXPECT_GE(peakRssBytes(), touched.size());
  EXPECT_GT(processCpuSeconds(), cpuBefore);
}

}  // namespace
}  // namespace farcell
