#include "cache/base/parallel.h"

#include <gtest/gtest.h>

#include <atomic>
#include <numeric>
#include <thread>
#include <vector>

namespace farcell {
namespace {

TEST(Parallel, EveryIndexIsCalledOnceByAWorkerInRangeWhateverTheNumberOfThreads) {
  for (const int threads : {-3, 0, 1, 2, 3, 8, 33}) {
    for (const size_t count : {0u, 1u, 2u, 7u, 1000u}) {
      std::vector<std::atomic<int>> calls(count);
      std::atomic<int> badWorkers{0};
      parallelFor(count, threads, [&](size_t index, int worker) {
        ++calls[index];
        if (worker < 0 || worker >= std::max(1, threads)) ++badWorkers;
      });
      for (const auto& called : calls) ASSERT_EQ(called.load(), 1) << threads << " threads, count " << count;
      ASSERT_EQ(badWorkers.load(), 0);
    }
  }
}

TEST(Parallel, AWorkerNumberIsNeverUsedByTwoThreadsAtOnce) {
  // Scratch memory is indexed by worker: plain, unsynchronised counters must come out exact.
  std::vector<uint64_t> sums(4, 0);
  parallelFor(100'000, 4, [&](size_t index, int worker) { sums[static_cast<size_t>(worker)] += index; });
  EXPECT_EQ(std::accumulate(sums.begin(), sums.end(), uint64_t{0}), uint64_t{100'000} * 99'999 / 2);
}

TEST(Parallel, ResultsStoredByIndexDoNotDependOnWhichThreadWasFaster) {
  const auto run = [](int threads) {
    std::vector<double> values(5000);
    parallelFor(values.size(), threads, [&](size_t index, int worker) {
      if ((index + static_cast<size_t>(worker)) % 97 == 0) std::this_thread::yield();
      values[index] = 1.0 / static_cast<double>(index + 1);
    });
    return values;
  };
  const std::vector<double> serial = run(1);
  for (int round = 0; round < 10; ++round) ASSERT_EQ(run(2 + round), serial);
}

TEST(Parallel, OneThreadCallsInRisingOrderOnTheCallersThread) {
  std::vector<size_t> order;
  const auto caller = std::this_thread::get_id();
  parallelFor(100, 1, [&](size_t index, int worker) {
    EXPECT_EQ(worker, 0);
    EXPECT_EQ(std::this_thread::get_id(), caller);
    order.push_back(index);
  });
  std::vector<size_t> expected(100);
  std::iota(expected.begin(), expected.end(), size_t{0});
  EXPECT_EQ(order, expected);
}

TEST(Parallel, ThreadCountIsWhatWasAskedForWithinReason) {
  EXPECT_EQ(threadCount(3), 3);
  EXPECT_EQ(threadCount(1'000'000), kMaxThreads);
  EXPECT_GE(threadCount(0), 1);
  EXPECT_EQ(threadCount(-5), threadCount(0));
}

}  // namespace
}  // namespace farcell
