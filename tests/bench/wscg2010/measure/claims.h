// What the paper says, and whether these measurements agree.
#pragma once

#include <string>
#include <vector>

#include "tests/bench/wscg2010/measure/experiment.h"

namespace farcell::wscg {

struct Claim {
  std::string text;      // the paper's, shortened
  std::string verdict;   // "holds", "does not hold", "depends", or "not measured"
  std::string sentence;  // the figures it rests on
};

// In the order of the paper. Claims about several models hold when they hold for each.
std::vector<Claim> judgeClaims(const ExperimentResults& results, const ExperimentSettings& settings);

}  // namespace farcell::wscg
