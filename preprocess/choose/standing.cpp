#include "preprocess/choose/standing.h"

#include <cmath>

namespace farcell {

Standing standingAround(const Grid& grid, const CellRecord& cell) {
  const GridBox cube = cellBox(grid, cell.key);
  Standing standing;
  standing.centre = glm::dvec3(cell.content.min + cell.content.max) * 0.5;
  standing.halfExtent = glm::dvec3(cell.content.max - cell.content.min) * 0.5;
  standing.leaf = cell.childCount == 0;
  standing.sphereCentre = glm::dvec3(cube.min + cube.max) * 0.5;
  standing.sphereRadius = std::sqrt(3.0) * 0.5 * (cube.max.x - cube.min.x);
  return standing;
}

}  // namespace farcell
