// Costs from frames that were timed.
#pragma once

#include <span>

#include "runtime/cost/draw_costs.h"

namespace farcell {

struct TimedFrame {
  FrameWork work;
  double ms = 0;  // > 0
};

// The costs, none below 0, of the least sum of squared relative errors (Lawson, Hanson, Solving Least Squares Problems,
// 1974, chapter 23, by coordinate descent). A cost of which no frame has any is 0.
DrawCosts fitCosts(std::span<const TimedFrame> frames);

}  // namespace farcell
