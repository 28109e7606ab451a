// The setting with which one renderer takes as long as another.
#pragma once

#include <functional>

#include "cache/base/result.h"

namespace farcell {

// A setting in [low, high] that makes a frame take `targetMs` by time(setting), which should fall as the setting rises:
// bisection of its logarithm, `steps` measurements after that of `high`. Of those measured, the least whose time is at
// most targetMs (times are noisy: it may be beaten by one that was not measured); `high` when none is. Ends with the
// first failure of `time`. REQUIRES: 0 < low < high.
Result<double> settingOfTime(double low, double high, int steps, double targetMs,
                             const std::function<Result<double>(double setting)>& time);

}  // namespace farcell
