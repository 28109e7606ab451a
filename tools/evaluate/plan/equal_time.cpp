#include "tools/evaluate/plan/equal_time.h"

#include <cmath>

#include "cache/base/check.h"

namespace farcell {

Result<double> settingOfTime(double low, double high, int steps, double targetMs,
                             const std::function<Result<double>(double setting)>& time) {
  FARCELL_CHECK(low > 0 && low < high);
  FARCELL_ASSIGN(const double fastestMs, time(high));
  if (fastestMs > targetMs) return high;
  double slow = low, fast = high;
  for (int step = 0; step < steps; ++step) {
    const double middle = std::sqrt(slow * fast);
    FARCELL_ASSIGN(const double ms, time(middle));
    (ms <= targetMs ? fast : slow) = middle;
  }
  return fast;
}

}  // namespace farcell
