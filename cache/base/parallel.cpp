#include "cache/base/parallel.h"

#include <algorithm>
#include <atomic>
#include <thread>
#include <vector>

namespace farcell {

int threadCount(int requested) {
  if (requested > 0) return std::min(requested, kMaxThreads);
  return std::clamp(static_cast<int>(std::thread::hardware_concurrency()), 1, kMaxThreads);
}

void parallelFor(size_t count, int threads, const std::function<void(size_t, int)>& work) {
  std::atomic<size_t> next{0};
  const auto run = [&](int worker) {
    for (size_t index = next++; index < count; index = next++) work(index, worker);
  };
  const int helpers = static_cast<int>(std::min(count, static_cast<size_t>(std::max(1, threads)))) - 1;
  std::vector<std::jthread> pool;
  for (int worker = 1; worker <= helpers; ++worker) pool.emplace_back(run, worker);
  run(0);
}

}  // namespace farcell
