#include "cache/schema/grid.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace farcell {
namespace {

// Spreads the low 21 bits of v so that two zero bits follow each.
uint64_t spreadBits(uint64_t v) {
  v &= 0x1fffff;
  v = (v | v << 32) & 0x1f00000000ffffull;
  v = (v | v << 16) & 0x1f0000ff0000ffull;
  v = (v | v << 8) & 0x100f00f00f00f00full;
  v = (v | v << 4) & 0x10c30c30c30c30c3ull;
  v = (v | v << 2) & 0x1249249249249249ull;
  return v;
}

}  // namespace

GridPoint Grid::gridFromWorld(glm::dvec3 point) const {
  const double steps = static_cast<double>(int64_t{1} << bits);
  GridPoint result;
  for (int axis = 0; axis < 3; ++axis) {
    const double value = std::floor((point[axis] - origin[axis]) / side * steps + 0.5);
    result[axis] = static_cast<int32_t>(std::clamp(value, 0.0, steps));
  }
  return result;
}

Grid gridAround(glm::dvec3 min, glm::dvec3 max) {
  const glm::dvec3 extent = max - min;
  double side = std::max({extent.x, extent.y, extent.z});
  // A point or a box near the coordinates' own precision still gets a cube that can be cut, and whose margin is some
  // units in their last place.
  const double magnitude =
      std::max({std::abs(min.x), std::abs(min.y), std::abs(min.z), std::abs(max.x), std::abs(max.y), std::abs(max.z)});
  side = std::max({side, magnitude * 1e-11, std::numeric_limits<double>::min() * 1e30});
  side *= 1.0 + 1.0 / 4096;
  return Grid{(min * 0.5 + max * 0.5) - glm::dvec3(side * 0.5), side, kMaxGridBits};
}

uint64_t mortonCode(const CellKey& key) { return spreadBits(key.x) | spreadBits(key.y) << 1 | spreadBits(key.z) << 2; }

GridBox cellBox(const Grid& grid, const CellKey& key) {
  const int shift = grid.bits - static_cast<int>(key.level);
  const GridPoint min(static_cast<int32_t>(key.x << shift), static_cast<int32_t>(key.y << shift),
                      static_cast<int32_t>(key.z << shift));
  return GridBox{min, min + GridPoint(int32_t{1} << shift)};
}

glm::dvec3 cellCentre(const Grid& grid, const CellKey& key) {
  const GridBox box = cellBox(grid, key);
  return grid.origin + glm::dvec3(box.min + box.max) * (0.5 * grid.step());
}

double cellHalfSide(const Grid& grid, const CellKey& key) {
  return std::ldexp(grid.side, -static_cast<int>(key.level) - 1);
}

}  // namespace farcell
