// The builds of a list, one after the other or a few at a time; see tools/batch/plan for the list and for what is kept
// of each build.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "cache/base/progress.h"
#include "cache/base/result.h"
#include "tools/batch/plan/data_set_list.h"

namespace farcell {

struct BatchOptions {
  std::filesystem::path list;    // file of the data sets
  std::filesystem::path output;  // directory of the packs, made when absent
  int jobs = 1;
  bool stopOnFailure = false;
  ProgressForm progress = ProgressForm::automatic;
};

enum class Outcome { ok, failed, current, notRun };  // current: built before, of the same files

struct DataSetResult {
  std::string name;
  Outcome outcome = Outcome::notRun;
  uint64_t triangles = 0;
  double seconds = 0;
  uint64_t peakRssBytes = 0;
  uint64_t packBytes = 0;
  std::string message;  // why it failed
};

const char* nameOf(Outcome outcome);  // "ok", "failed", "skipped as current", "not run"

// In the order of the list. `onResult` hears of each as soon as it is known, one at a time. A build that fails is a
// result; an error is what concerns all of them.
Result<std::vector<DataSetResult>> runBatch(const BatchOptions& options,
                                            const std::function<void(const DataSetResult&)>& onResult);

}  // namespace farcell
