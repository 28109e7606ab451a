#include "cache/base/process.h"

#include <sys/resource.h>
#include <unistd.h>

#include <fstream>

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

uint64_t rssBytes() {
  std::ifstream file("/proc/self/statm");
  uint64_t pages = 0, resident = 0;
  file >> pages >> resident;
  return resident * static_cast<uint64_t>(::sysconf(_SC_PAGESIZE));
}

double processCpuSeconds() {
  const rusage value = usage();
  return seconds(value.ru_utime) + seconds(value.ru_stime);
}

}  // namespace farcell
