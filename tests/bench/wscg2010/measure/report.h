// results.md and the CSV files.
#pragma once

#include <filesystem>
#include <string>

#include "tests/bench/wscg2010/measure/experiment.h"

namespace farcell::wscg {

// How a run was made, for the report's head.
struct RunFacts {
  std::string processor;
  int threads = 0;
  double memoryGb = 0;
  double minutes = 0;
  double peakMb = 0;
  bool quick = false;
};
// What the machine says of itself; minutes and quick are left to the caller.
RunFacts machineFacts();

// Writes results.md, errors.csv, times.csv and sizes.csv into settings.output.
Result<> writeReport(const ExperimentResults& results, const ExperimentSettings& settings, const RunFacts& facts);

}  // namespace farcell::wscg
