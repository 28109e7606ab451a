// Where things are. World positions are double; a model's root cube is cut into 2^bits steps along each axis,
// and every stored vertex is an integer on that grid, so that two cells that share a corner share its bits.
#pragma once

#include <algorithm>
#include <compare>
#include <cstdint>
#include <glm/vec3.hpp>

namespace farcell {

using GridPoint = glm::ivec3;  // steps from the grid's origin; in [0, 2^bits]

// An axis-aligned box in grid steps, both ends included. Empty when min > max on an axis.
struct GridBox {
  GridPoint min{INT32_MAX};
  GridPoint max{INT32_MIN};

  bool empty() const { return min.x > max.x || min.y > max.y || min.z > max.z; }
  void include(GridPoint point) {
    min = GridPoint(std::min(min.x, point.x), std::min(min.y, point.y), std::min(min.z, point.z));
    max = GridPoint(std::max(max.x, point.x), std::max(max.y, point.y), std::max(max.z, point.z));
  }
  void include(const GridBox& box) {
    if (box.empty()) return;
    include(box.min);
    include(box.max);
  }
  bool operator==(const GridBox&) const = default;
};

inline constexpr int kMinGridBits = 16;
inline constexpr int kMaxGridBits = 24;  // a cell-local coordinate is exact in a float
inline constexpr int kMaxLevel = 15;     // octree depth limit; a leaf keeps at least 2^(bits-level) steps

// The root cube: [origin, origin + side]^3, world coordinates and model units.
struct Grid {
  glm::dvec3 origin{0};
  double side = 1;
  int bits = kMaxGridBits;

  double step() const { return side / static_cast<double>(int64_t{1} << bits); }
  glm::dvec3 worldFromGrid(GridPoint point) const { return origin + glm::dvec3(point) * step(); }
  // Nearest grid point, clamped to the root cube.
  GridPoint gridFromWorld(glm::dvec3 point) const;
  bool operator==(const Grid&) const = default;
};

// The smallest cube around [min, max], a little larger so that nothing lies on its faces; centred on the box.
// Works for any scale and offset, flat and single-point boxes included (side is never zero).
Grid gridAround(glm::dvec3 min, glm::dvec3 max);

// One octree cube. level 0 is the root; x, y, z in [0, 2^level).
struct CellKey {
  uint32_t level = 0;
  uint32_t x = 0;
  uint32_t y = 0;
  uint32_t z = 0;

  auto operator<=>(const CellKey&) const = default;
  CellKey parent() const { return {level - 1, x / 2, y / 2, z / 2}; }
  // octant bit 0: x, bit 1: y, bit 2: z
  CellKey child(uint32_t octant) const {
    return {level + 1, 2 * x + (octant & 1), 2 * y + (octant >> 1 & 1), 2 * z + (octant >> 2 & 1)};
  }
  uint32_t octant() const { return (x & 1) | (y & 1) << 1 | (z & 1) << 2; }
};

// Bits of x, y, z interleaved, x lowest: the order of cells in a file and of children in a parent.
uint64_t mortonCode(const CellKey& key);

// The cube of a cell, in grid steps (its max face is the next cell's min face) and in the world.
GridBox cellBox(const Grid& grid, const CellKey& key);
glm::dvec3 cellCentre(const Grid& grid, const CellKey& key);
double cellHalfSide(const Grid& grid, const CellKey& key);

}  // namespace farcell
