// Which ways of drawing are worth considering: those that no other beats in both error and time.
#pragma once

#include <span>
#include <vector>

namespace farcell {

struct ErrorAndTime {
  double error = 0;
  double ms = 0;  // or another cost
};

// For each point whether it lies on the front: no other is at most as large in both and smaller in one of them. Equal
// points lie on it together. REQUIRES: no NaN.
std::vector<bool> paretoFront(std::span<const ErrorAndTime> points);

}  // namespace farcell
