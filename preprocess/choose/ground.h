// How low a visitor above the ground may be: a surface that lies nowhere above the true ground, as far as the boxes of
// cells tell (a model may have no ground at all: houses only). A visitor's eye is at or above it.
//
// The ground of a column of cells is the lowest content in it: a hill carries its houses. But a column may hold nothing
// but what hangs over the ground (a bridge, a chin), or nothing. So the surface rises no steeper than kGroundSlope from
// what is lowest around: it is the lower envelope of cones over every column's lowest content. Where the ground is
// really steeper, the surface is below it, which is safe. Outside the root cube it is as low as the lowest content.
#pragma once

#include <span>
#include <vector>

#include "preprocess/choose/standing.h"

namespace farcell {

inline constexpr double kGroundSlope = 0.25;
inline constexpr int kGroundLevel = 8;  // columns are as wide as cells of this level

class Ground {
 public:
  Ground(const Model& model, std::span<const CellRecord> cells);

  // Height along the up axis, grid steps, of the surface at a point of the world in grid steps.
  double heightAt(glm::dvec3 point) const;

  // The lowest sine of elevation (never above it, at most 0) at which somebody at or above the ground, standing where
  // the cell's views are drawn, is seen from the centre of its content.
  double lowestSine(const Standing& standing) const;

 private:
  void addContent(const GridBox& content);
  void flatten();
  void buildPyramid();
  void visit(const Standing& standing, int level, int east, int north, double& lowest) const;
  double& at(int level, int east, int north) {
    return heights_[static_cast<size_t>(level)][static_cast<size_t>(north) << level | static_cast<size_t>(east)];
  }
  double at(int level, int east, int north) const { return const_cast<Ground*>(this)->at(level, east, north); }

  int bits_;
  int up_, east_, north_;                     // axes
  double lowest_;                             // of all
  std::vector<std::vector<double>> heights_;  // by level, then rows of columns: the least below; grid steps
};

}  // namespace farcell
