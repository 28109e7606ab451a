// A program that runs beside this one, so that its crash is a result and not the end.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "cache/base/result.h"

namespace farcell {

struct ChildOutcome {
  int exitCode = 0;  // of one that was killed: 128 + the signal, as shells say it
  int signal = 0;
  std::string out;  // its stdout, up to a bound
  uint64_t peakRssBytes = 0;
  double seconds = 0;
};

// Runs `program` in `directory` and waits for it. Each line of its stderr is handed over without its end. Ctrl-C does
// not reach it (it has a process group of its own) but is passed on, once; so is the death of this process.
Result<ChildOutcome> runChild(const std::filesystem::path& program, const std::vector<std::string>& arguments,
                              const std::filesystem::path& directory,
                              const std::function<void(std::string_view)>& onErrorLine);

}  // namespace farcell
