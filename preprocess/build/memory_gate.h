// Work that needs memory waits here until there is enough of it: shares are what jobs say they will use, not measured.
// Who holds a share asks for no other, so that nobody waits for himself.
#pragma once

#include <condition_variable>
#include <cstdint>
#include <mutex>

#include "cache/base/result.h"

namespace farcell {

class MemoryGate {
 public:
  explicit MemoryGate(uint64_t bytes) : capacity_(bytes), free_(bytes) {}

  // Holds its share while it lives.
  class Share {
   public:
    Share(MemoryGate& gate, uint64_t bytes) : gate_(&gate), bytes_(bytes) {}
    Share(Share&& other) noexcept : gate_(std::exchange(other.gate_, nullptr)), bytes_(other.bytes_) {}
    Share(const Share&) = delete;
    Share& operator=(const Share&) = delete;
    ~Share() {
      if (gate_ != nullptr) gate_->giveBack(bytes_);
    }

   private:
    MemoryGate* gate_;
    uint64_t bytes_;
  };

  // Waits. exhausted when so much will never be free; `what` says for what.
  Result<Share> take(uint64_t bytes, const std::string& what) {
    if (bytes > capacity_)
      return fail(ErrorKind::exhausted, "{}: expected {} MiB of memory at most, found a need of {} MiB: raise --memory",
                  what, capacity_ >> 20, (bytes >> 20) + 1);
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [&] { return free_ >= bytes; });
    free_ -= bytes;
    return Share(*this, bytes);
  }

 private:
  void giveBack(uint64_t bytes) {
    {
      const std::lock_guard lock(mutex_);
      free_ += bytes;
    }
    changed_.notify_all();
  }

  const uint64_t capacity_;
  std::mutex mutex_;
  std::condition_variable changed_;
  uint64_t free_;  // guarded by mutex_
};

}  // namespace farcell
