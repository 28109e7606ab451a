#include "cache/base/interrupt.h"

#include <csignal>

namespace farcell {
namespace {
volatile std::sig_atomic_t gInterrupted = 0;

void onSignal(int signal) {
  gInterrupted = 1;
  std::signal(signal, SIG_DFL);
}
}  // namespace

void installInterruptHandler() {
  std::signal(SIGINT, onSignal);
  std::signal(SIGTERM, onSignal);
}

bool interrupted() { return gInterrupted != 0; }

Result<> checkInterrupt() {
  if (interrupted()) return fail(ErrorKind::cancelled, "interrupted");
  return {};
}

}  // namespace farcell
