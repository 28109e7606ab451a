// Work spread over threads by index. Results must be stored by index, so that their order never depends on
// which thread was faster.
#pragma once

#include <cstddef>
#include <functional>

namespace farcell {

inline constexpr int kMaxThreads = 1024;

// Number of threads for `requested` (0: all the machine offers), at most kMaxThreads.
int threadCount(int requested);

// Calls work(index, worker) once for every index in [0, count), from `threads` threads (worker in [0, threads)),
// lowest index first. Returns when all are done. work must not throw.
void parallelFor(size_t count, int threads, const std::function<void(size_t index, int worker)>& work);

}  // namespace farcell
