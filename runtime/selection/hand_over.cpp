#include "runtime/selection/hand_over.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <tuple>
#include <vector>

namespace farcell {
namespace {

constexpr double kDetailSpread = 0.08;  // the least and the greatest detail differ from 1 by so much
constexpr double kLeanRad = 0.05;       // between the direction to the eye and that of a share

// Corners of a tetrahedron: seen from anywhere they lie around the middle.
constexpr std::array<std::array<double, 3>, kShares> kLeans = {{{1, 1, 1}, {1, -1, -1}, {-1, 1, -1}, {-1, -1, 1}}};

SelectionSettings settingsOf(int share, SelectionSettings settings) {
  const auto& lean = kLeans[static_cast<size_t>(share)];
  settings.detail *= 1 + kDetailSpread * (2.0 * share / (kShares - 1) - 1);
  settings.lean = glm::dvec3(lean[0], lean[1], lean[2]) * (kLeanRad / std::sqrt(3.0));
  return settings;
}

// Orders cells front to back as `selection.h` says; a cell comes before those below it.
uint64_t depthOrder(const Directory& directory, glm::dvec3 eyeSteps, uint32_t index) {
  uint64_t order = 0;
  for (const CellRecord* cell = &directory.cells[index]; cell->parent != kNone;) {
    const CellRecord& parent = directory.cells[cell->parent];
    const GridBox box = cellBox(directory.model.grid, parent.key);
    uint32_t eyeOctant = 0;
    for (int axis = 0; axis < 3; ++axis)
      if (2 * eyeSteps[axis] >= static_cast<double>(box.min[axis]) + box.max[axis]) eyeOctant |= 1u << axis;
    order |= uint64_t{cell->key.octant() ^ eyeOctant} << (3 * (static_cast<uint32_t>(kMaxLevel) - cell->key.level));
    cell = &parent;
  }
  return order;
}

auto identity(const CutEntry& entry) {
  return std::tie(entry.cell, entry.representation, entry.view, entry.secondView);
}

struct Placed {
  uint64_t order;
  CutEntry entry;
};

bool before(const Placed& a, const Placed& b) {
  return a.order != b.order ? a.order < b.order : identity(a.entry) < identity(b.entry);
}

void merge(const Directory& directory, std::vector<Placed> placed, Cut& cut) {
  std::sort(placed.begin(), placed.end(), before);
  cut.entries.clear();
  cut.triangles = 0;
  for (const Placed& next : placed) {
    if (!cut.entries.empty() && identity(cut.entries.back()) == identity(next.entry)) {
      cut.entries.back().shares |= next.entry.shares;
      continue;
    }
    cut.entries.push_back(next.entry);
    if (next.entry.representation != Representation::impostor)
      cut.triangles += directory.cells[next.entry.cell].meshTriangles;
  }
}

}  // namespace

Cut selectHandOver(const Directory& directory, const Camera& camera, int width, int height,
                   const SelectionSettings& settings, const HiddenCells* hidden) {
  const Grid& grid = directory.model.grid;
  const glm::dvec3 eyeSteps = (camera.position - grid.origin) / grid.step();
  std::vector<Placed> placed;
  Cut cut;
  double nearestSteps = cut.nearestSteps;
  for (int share = 0; share < kShares; ++share) {
    const SelectionSettings own = settingsOf(share, settings);
    cut = selectCut(directory, camera, width, height, own, hidden);
    nearestSteps = std::min(nearestSteps, cut.nearestSteps);
    for (CutEntry entry : cut.entries) {
      entry.shares = static_cast<uint8_t>(1u << share);
      entry.errorPixels /= own.detail;
      placed.push_back({depthOrder(directory, eyeSteps, entry.cell), entry});
    }
  }
  merge(directory, std::move(placed), cut);
  cut.nearestSteps = nearestSteps;
  return cut;
}

}  // namespace farcell
