#include "cache/base/progress.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cstdio>

namespace farcell {
namespace {
constexpr int64_t kPrintEveryMs = 200;

double secondsSince(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}
}  // namespace

Progress::Progress(bool enabled) : enabled_(enabled), terminal_(::isatty(STDERR_FILENO) == 1) {}

void Progress::begin(const std::string& stage, uint64_t total, const std::string& unit) {
  end();
  const std::lock_guard lock(mutex_);
  stage_ = stage;
  unit_ = unit;
  total_ = total;
  tenthsPrinted_ = 0;
  done_ = 0;
  nextPrintMs_ = kPrintEveryMs;
  start_ = std::chrono::steady_clock::now();
}

void Progress::advance(uint64_t units) {
  const uint64_t done = done_.fetch_add(units) + units;
  if (!enabled_) return;
  const int64_t nowMs = static_cast<int64_t>(secondsSince(start_) * 1000);
  int64_t due = nextPrintMs_.load();
  if (nowMs < due || !nextPrintMs_.compare_exchange_strong(due, nowMs + kPrintEveryMs)) return;
  const std::lock_guard lock(mutex_);
  print(done, false);
}

void Progress::end() {
  const std::lock_guard lock(mutex_);
  if (enabled_ && !stage_.empty()) print(done_.load(), true);
  stage_.clear();
}

void Progress::print(uint64_t done, bool last) {
  const double seconds = secondsSince(start_);
  const double share = total_ > 0 ? static_cast<double>(done) / static_cast<double>(total_) : 1.0;
  const int tenths = static_cast<int>(share * 10);
  if (!terminal_ && !last && tenths <= tenthsPrinted_) return;
  tenthsPrinted_ = tenths;
  const double rate = seconds > 0 ? static_cast<double>(done) / seconds : 0;
  std::string line =
      fmt::format("{:<10} {:3.0f}% {:>12}/{} {}, {:.3g}/s", stage_, share * 100, done, total_, unit_, rate);
  if (last)
    line += fmt::format(", {:.1f} s", seconds);
  else if (share > 0)
    line += fmt::format(", {:.0f} s left", seconds * (1 - share) / share);
  if (terminal_)
    std::fputs(fmt::format("\r{:<78}{}", line, last ? "\n" : "").c_str(), stderr);
  else
    std::fputs((line + "\n").c_str(), stderr);
  std::fflush(stderr);
}

}  // namespace farcell
