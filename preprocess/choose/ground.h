// How low a visitor above the ground may be, as far as the boxes of cells tell (a model may have no ground at all:
// houses only). A visitor's eye is at or above it.
//
// The ground of a column of cells is the lowest content in it: on a hill it is as high as the hill. But a column may
// hold nothing but what hangs over the ground (a bridge, a chin), or nothing. So the ground rises no steeper than
// kGroundSlope from what is lowest around: the lower envelope of cones over every column's lowest content. Wherever the
// model has its ground as content, the true ground is at or above this; where it has none, it is taken to fall no
// deeper below what is around than the envelope says. Outside the root cube the ground is as low as the lowest content.
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
  static size_t place(int level, int east, int north) {
    return static_cast<size_t>(north) << level | static_cast<size_t>(east);
  }
  double& at(int level, int east, int north) { return heights_[static_cast<size_t>(level)][place(level, east, north)]; }
  double at(int level, int east, int north) const {
    return heights_[static_cast<size_t>(level)][place(level, east, north)];
  }

  int bits_;
  int up_, east_, north_;                     // axes
  double lowest_;                             // of all
  std::vector<std::vector<double>> heights_;  // by level, then rows of columns: the least below; grid steps
};

}  // namespace farcell
