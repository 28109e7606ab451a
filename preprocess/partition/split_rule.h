// When a cell is split, and how its contents go to its octants.
#pragma once

#include <array>
#include <cstdint>

#include "cache/schema/model.h"
#include "preprocess/partition/grid_triangle.h"
#include "preprocess/partition/record_format.h"

namespace farcell {

// See partition.h.
class SplitRule {
 public:
  enum class Choice { leaf, split, byArea };
  SplitRule(const BuildSettings& settings, int gridBits) : settings_(settings), gridBits_(gridBits) {}

  Choice choice(uint32_t level, uint64_t triangles) const;
  // What Choice::byArea asks for. areaSteps2: of all triangles of the cell, grid steps squared.
  bool finerThanTexels(uint32_t level, uint64_t triangles, double areaSteps2) const;
  // Whether a split into `after` pieces would only make more of the same.
  bool multiplies(uint64_t before, uint64_t after) const;
  // No cell lies deeper.
  int deepest() const { return settings_.fixedLevel >= 0 ? settings_.fixedLevel : settings_.maxLevel; }

 private:
  BuildSettings settings_;
  int gridBits_;
};

double areaOf(const Corners& corners);
double areaOf(const GridPolygon& polygon);

// The three planes through a cell's centre.
GridPoint middleOf(int gridBits, const CellKey& key);
// Cuts along x, then y, then z. Parts without area have count 0.
using OctantPolygons = std::array<GridPolygon, 8>;
void cutToOctants(const GridPolygon& polygon, GridPoint middle, OctantPolygons& octants);

}  // namespace farcell
