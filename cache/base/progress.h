// Progress of long work on stderr, never on stdout, which belongs to data: on a terminal a bar that moves (stage,
// share, rate, time left, use of each budget), elsewhere a line at each tenth, or JSON for machines (progress_text.h
// shows each). With JSON, a line {"event":"done","seconds":61.2} follows when the Progress ends its life, whatever came
// of the work: that the exit code tells.
#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <functional>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "cache/base/progress_text.h"

namespace farcell {

enum class ProgressForm { none, automatic, bar, json };  // automatic: a bar on a terminal, else lines
// "none", "auto", "bar" or "json".
std::optional<ProgressForm> progressFormNamed(std::string_view name);

class Progress {
 public:
  explicit Progress(ProgressForm form);
  explicit Progress(bool enabled) : Progress(enabled ? ProgressForm::automatic : ProgressForm::none) {}
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;
  ~Progress();

  // From now on the use of `limit` bytes (0: not known) is shown. `used` is asked a few times a second, by any thread,
  // one at a time; all it looks at must outlive this object. Named like one before, it takes that one's place.
  void budget(const std::string& name, uint64_t limit, std::function<uint64_t()> used);
  // Begins a stage of `total` units, e.g. ("bake", 14000, "views"). Ends the one before. Where several kinds of work go
  // on at a time, they are one stage, and its total their sum.
  void begin(const std::string& stage, uint64_t total, const std::string& unit);
  // Any thread.
  void advance(uint64_t units = 1);
  // Ends the last stage with a line of its duration.
  void end();

 private:
  struct Budget {
    std::string name;
    uint64_t limit;
    std::function<uint64_t()> used;
  };
  enum class Event { begin, advance, end };

  void print(Event event);
  std::string textOf(Event event, const StageProgress& stage) const;

  const ProgressForm form_;  // never automatic
  const bool lines_;         // as lines: no bar, no JSON
  const std::chrono::steady_clock::time_point created_ = std::chrono::steady_clock::now();
  std::atomic<uint64_t> done_{0};
  std::atomic<int64_t> nextPrintMs_{0};
  std::atomic<std::chrono::steady_clock::time_point> start_{};
  std::mutex mutex_;
  // Guarded by mutex_:
  std::vector<Budget> budgets_;
  std::string stage_;
  std::string unit_;
  uint64_t total_ = 0;
  int tenthsPrinted_ = 0;
  bool barStands_ = false;  // the cursor is at the end of a bar
};

}  // namespace farcell
