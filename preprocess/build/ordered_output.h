// Results of parallel work, taken in order: job 0 first, whichever finished first.
#pragma once

#include <condition_variable>
#include <functional>
#include <map>
#include <mutex>
#include <optional>

#include "cache/base/result.h"

namespace farcell {

// `write` is called once for each index in rising order, by whichever thread completes the sequence. A thread that is
// more than `window` jobs ahead waits, so that finished results do not pile up. After a first error nothing more is
// written and nobody waits.
template <class T>
class OrderedOutput {
 public:
  OrderedOutput(size_t window, std::function<Result<>(size_t, T&&)> write)
      : window_(window), write_(std::move(write)) {}

  void put(size_t index, Result<T> value) {
    std::unique_lock lock(mutex_);
    turn_.wait(lock, [&] { return error_ || index < next_ + window_; });
    if (!error_ && !value) error_ = value.error();
    if (!error_) waiting_.emplace(index, std::move(*value));
    while (!error_ && !waiting_.empty() && waiting_.begin()->first == next_) {
      if (const Result<> written = write_(next_, std::move(waiting_.begin()->second)); !written)
        error_ = written.error();
      waiting_.erase(waiting_.begin());
      ++next_;
    }
    turn_.notify_all();
  }
  bool failed() {
    const std::lock_guard lock(mutex_);
    return error_.has_value();
  }
  Result<> result() {
    const std::lock_guard lock(mutex_);
    if (error_) return tl::unexpected<Error>(*error_);
    return {};
  }

 private:
  const size_t window_;
  const std::function<Result<>(size_t, T&&)> write_;
  std::mutex mutex_;
  std::condition_variable turn_;
  // Guarded by mutex_:
  size_t next_ = 0;
  std::map<size_t, T> waiting_;
  std::optional<Error> error_;
};

}  // namespace farcell
