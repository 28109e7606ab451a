#include "cache/base/interrupt.h"

#include <atomic>
#include <csignal>

namespace farcell {
namespace {
// Any thread asks; a signal handler may store to it because it is lock-free.
std::atomic<bool> gInterrupted{false};
static_assert(std::atomic<bool>::is_always_lock_free);

void onSignal(int) {
  gInterrupted = true;
  std::signal(SIGINT, SIG_DFL);
  std::signal(SIGTERM, SIG_DFL);
}
}  // namespace

void installInterruptHandler() {
  std::signal(SIGINT, onSignal);
  std::signal(SIGTERM, onSignal);
}

bool interrupted() { return gInterrupted; }

Result<> checkInterrupt() {
  if (interrupted()) return fail(ErrorKind::cancelled, "interrupted");
  return {};
}

}  // namespace farcell
