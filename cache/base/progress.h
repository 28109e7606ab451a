// Progress of long work on stderr: stage, share done, rate, time left. Silent when stderr is no terminal
// unless asked for, then a line at each tenth; never on stdout, which belongs to data.
#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <mutex>
#include <string>

namespace farcell {

class Progress {
 public:
  explicit Progress(bool enabled);
  // Begins a stage of `total` units, e.g. ("bake", 14000, "views"). Ends the one before.
  void begin(const std::string& stage, uint64_t total, const std::string& unit);
  // Any thread.
  void advance(uint64_t units = 1);
  // Ends the last stage with a line of its duration.
  void end();

 private:
  void print(uint64_t done, bool last);

  const bool enabled_;
  const bool terminal_;
  std::atomic<uint64_t> done_{0};
  std::atomic<int64_t> nextPrintMs_{0};
  std::mutex mutex_;
  // Guarded by mutex_ while a stage runs:
  std::string stage_;
  std::string unit_;
  uint64_t total_ = 0;
  int tenthsPrinted_ = 0;
  std::chrono::steady_clock::time_point start_;
};

}  // namespace farcell
