#include "cache/base/progress.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
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
