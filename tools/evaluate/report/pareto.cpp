#include "tools/evaluate/report/pareto.h"

#include <algorithm>
#include <numeric>
#include <tuple>

namespace farcell {

std::vector<bool> paretoFront(std::span<const ErrorAndTime> points) {
  std::vector<size_t> order(points.size());
  std::iota(order.begin(), order.end(), size_t{0});
  const auto key = [&](size_t i) { return std::tuple(points[i].ms, points[i].error); };
  std::sort(order.begin(), order.end(), [&](size_t a, size_t b) { return key(a) < key(b); });
  // In the order of time, the front is where the error falls, and what equals the last of it.
  std::vector<bool> front(points.size(), false);
  const size_t* last = nullptr;
  for (const size_t& i : order) {
    front[i] = !last || points[i].error < points[*last].error || key(i) == key(*last);
    if (front[i]) last = &i;
  }
  return front;
}

}  // namespace farcell
