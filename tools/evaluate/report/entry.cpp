#include "tools/evaluate/report/entry.h"

#include <algorithm>
#include <cmath>

#include "cache/base/check.h"

namespace farcell {

double medianOf(std::vector<double> values) {
  FARCELL_CHECK(!values.empty());
  std::sort(values.begin(), values.end());
  const size_t middle = values.size() / 2;
  return values.size() % 2 != 0 ? values[middle] : (values[middle - 1] + values[middle]) / 2;
}

FrameTimes frameTimes(std::vector<double> wallMs) {
  FARCELL_CHECK(!wallMs.empty());
  std::sort(wallMs.begin(), wallMs.end());
  const auto rank = static_cast<size_t>(std::ceil(0.95 * static_cast<double>(wallMs.size())));
  return {medianOf(wallMs), wallMs[rank - 1], wallMs.back()};
}

}  // namespace farcell
