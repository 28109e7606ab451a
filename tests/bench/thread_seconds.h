// The processor time of a benchmark's own thread: what others do on the machine counts little.
#pragma once

#include <time.h>

namespace farcell {

inline double threadSeconds() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

}  // namespace farcell
