#include "cache/base/process.h"

#include <sys/resource.h>

namespace farcell {
namespace {
rusage usage() {
  rusage value{};
  ::getrusage(RUSAGE_SELF, &value);
  return value;
}
double seconds(const timeval& time) {
  return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
}
}  // namespace

uint64_t peakRssBytes() { return static_cast<uint64_t>(usage().ru_maxrss) * 1024; }

double processCpuSeconds() {
  const rusage value = usage();
  return seconds(value.ru_utime) + seconds(value.ru_stime);
}

}  // namespace farcell
