#include "tools/evaluate/reference/leaves.h"

#include <algorithm>

namespace farcell {
namespace {

// The octant of the cell in which the eye lies, or towards which it lies.
uint32_t eyeOctant(const Grid& grid, const CellKey& key, glm::dvec3 eye) {
  const glm::dvec3 centre = cellCentre(grid, key);
  return (eye.x >= centre.x ? 1u : 0u) | (eye.y >= centre.y ? 2u : 0u) | (eye.z >= centre.z ? 4u : 0u);
}

struct Walk {
  const Directory& directory;
  const ReferenceView& view;
  std::vector<VisibleLeaf> leaves;

  void visit(uint32_t index) {
    const CellRecord& cell = directory.cells[index];
    if (cell.content.empty()) return;
    const Grid& grid = directory.model.grid;
    const auto bounds = screenBounds(view, grid.worldFromGrid(cell.content.min), grid.worldFromGrid(cell.content.max));
    if (!bounds) return;
    if (cell.childCount == 0) {
      if (cell.geometryPageCount > 0) leaves.push_back({index, *bounds});
      return;
    }
    visitChildren(cell);
  }

  // A child can hide another only if it lies on the eye's side of every plane that parts them, so octants differing
  // from the eye's in more axes come later: rising (octant ^ eye's octant) is such an order.
  void visitChildren(const CellRecord& cell) {
    const uint32_t eye = eyeOctant(directory.model.grid, cell.key, view.eye);
    std::vector<uint32_t> children(cell.childCount);
    for (uint32_t i = 0; i < cell.childCount; ++i) children[i] = cell.firstChild + i;
    std::sort(children.begin(), children.end(), [&](uint32_t a, uint32_t b) {
      return (directory.cells[a].key.octant() ^ eye) < (directory.cells[b].key.octant() ^ eye);
    });
    for (const uint32_t child : children) visit(child);
  }
};

}  // namespace

std::vector<VisibleLeaf> leavesFrontToBack(const Directory& directory, const ReferenceView& view) {
  Walk walk{directory, view, {}};
  if (!directory.cells.empty()) walk.visit(0);
  return std::move(walk.leaves);
}

}  // namespace farcell
