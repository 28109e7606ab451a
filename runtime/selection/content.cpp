#include "runtime/selection/content.h"

#include <algorithm>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>
#include <vector>

namespace farcell {
namespace {

constexpr double kFar = std::numeric_limits<double>::infinity();

double toBox(const GridBox& box, glm::dvec3 point) {
  return glm::length(point - glm::clamp(point, glm::dvec3(box.min), glm::dvec3(box.max)));
}

// Where the ray enters the box (negative: behind or around the eye) and leaves it; enter > leave where it misses.
struct Crossing {
  double enter = -kFar;
  double leave = kFar;
};
Crossing crossing(const GridBox& box, glm::dvec3 eye, glm::dvec3 direction) {
  Crossing result;
  for (int axis = 0; axis < 3; ++axis) {
    if (direction[axis] == 0) {
      if (eye[axis] < box.min[axis] || eye[axis] > box.max[axis]) return {kFar, -kFar};
      continue;
    }
    const double a = (box.min[axis] - eye[axis]) / direction[axis];
    const double b = (box.max[axis] - eye[axis]) / direction[axis];
    result.enter = std::max(result.enter, std::min(a, b));
    result.leave = std::min(result.leave, std::max(a, b));
  }
  return result;
}

// The least of a leaf's distances. `distance(box, leaf)` never falls from a cell to its children: what is not nearer
// than the best so far is left out with all below it.
template <class Distance>
double leastOver(const Directory& directory, const Distance& distance) {
  double best = kFar;
  std::vector<uint32_t> open;
  if (!directory.cells.empty()) open.push_back(0);
  while (!open.empty()) {
    const CellRecord& cell = directory.cells[open.back()];
    open.pop_back();
    if (cell.content.empty()) continue;
    const bool leaf = cell.childCount == 0;
    const double own = distance(cell.content, leaf);
    if (own >= best) continue;
    if (leaf) best = own;
    for (uint32_t child = 0; child < cell.childCount; ++child) open.push_back(cell.firstChild + child);
  }
  return best;
}

glm::dvec3 stepsOf(const Grid& grid, glm::dvec3 point) { return (point - grid.origin) / grid.step(); }

}  // namespace

double distanceToContent(const Directory& directory, glm::dvec3 point) {
  const Grid& grid = directory.model.grid;
  const glm::dvec3 steps = stepsOf(grid, point);
  return leastOver(directory, [&](const GridBox& box, bool) { return toBox(box, steps); }) * grid.step();
}

std::optional<double> distanceAlong(const Directory& directory, glm::dvec3 eye, glm::dvec3 direction) {
  const Grid& grid = directory.model.grid;
  const glm::dvec3 steps = stepsOf(grid, eye);
  const double least = leastOver(directory, [&](const GridBox& box, bool leaf) {
    const Crossing through = crossing(box, steps, direction);
    if (through.enter > through.leave || through.leave < 0) return kFar;
    return leaf && through.enter < 0 ? kFar : std::max(through.enter, 0.0);
  });
  if (least == kFar) return std::nullopt;
  return least * grid.step();
}

}  // namespace farcell
