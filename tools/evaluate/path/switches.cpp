#include "tools/evaluate/path/switches.h"

#include <algorithm>

namespace farcell {
namespace {

// How a cut draws each cell of the pack, and which cells have something drawn below them.
struct Drawn {
  std::vector<const CutEntry*> entries;
  std::vector<bool> below;
};

Drawn drawnBy(const Directory& directory, const Cut& cut) {
  Drawn drawn{std::vector<const CutEntry*>(directory.cells.size()), std::vector<bool>(directory.cells.size())};
  for (const CutEntry& entry : cut.entries) {
    drawn.entries[entry.cell] = &entry;
    for (uint32_t cell = directory.cells[entry.cell].parent; cell != kNone && !drawn.below[cell];
         cell = directory.cells[cell].parent)
      drawn.below[cell] = true;
  }
  return drawn;
}

bool isDrawnAbove(const Directory& directory, const Drawn& drawn, uint32_t cell) {
  for (cell = directory.cells[cell].parent; cell != kNone; cell = directory.cells[cell].parent)
    if (drawn.entries[cell] != nullptr) return true;
  return false;
}

bool sameViews(const CutEntry& a, const CutEntry& b, ImpostorKind kind) {
  if (kind == ImpostorKind::blended) {
    std::array<int, 3> first = a.blend.views, second = b.blend.views;
    std::sort(first.begin(), first.end());
    std::sort(second.begin(), second.end());
    return first == second;
  }
  return a.view == b.view && (kind == ImpostorKind::flat || a.secondView == b.secondView);
}

}  // namespace

Switches countSwitches(const Directory& directory, const Cut& before, const Cut& now, ImpostorKind kind) {
  const Drawn drawn = drawnBy(directory, before);
  Switches switches;
  for (const CutEntry& entry : now.entries) {
    const CutEntry* earlier = drawn.entries[entry.cell];
    if (earlier == nullptr)
      switches.levels += drawn.below[entry.cell] || isDrawnAbove(directory, drawn, entry.cell) ? 1 : 0;
    else if (earlier->representation != entry.representation)
      ++switches.levels;
    else if (entry.representation == Representation::impostor && !sameViews(*earlier, entry, kind))
      ++switches.views;
  }
  return switches;
}

}  // namespace farcell
