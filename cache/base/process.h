// What the operating system says this process used.
#pragma once

#include <cstdint>

namespace farcell {
uint64_t peakRssBytes();
uint64_t rssBytes();         // now
double processCpuSeconds();  // user + system, all threads
}  // namespace farcell
