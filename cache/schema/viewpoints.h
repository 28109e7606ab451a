// The directions from which impostors are baked: a regular icosahedron whose faces are split in four n times,
// vertices pushed to the unit sphere. Sets are named by their size: its vertices (12, 42, 162, 642: three
// neighbours to blend between) or its face centres (20, 80, 320, 1280: the 2010 paper's).
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "cache/base/result.h"

namespace farcell {

class Viewpoints {
 public:
  // count: one of 12, 42, 162, 642, 20, 80, 320, 1280; invalidArgument otherwise.
  static Result<Viewpoints> create(int count);
  static bool exists(int count);
  // That set, made when it is first asked for and kept. REQUIRES: exists(count). Any thread.
  static const Viewpoints& of(int count);

  int count() const { return static_cast<int>(directions_.size()); }
  // Unit vectors from the cell's centre to the viewer, world axes. Their order is part of the pack format.
  std::span<const glm::dvec3> directions() const { return directions_; }
  // Whether three neighbours can be asked for (vertex sets).
  bool hasTriangles() const { return !levels_.empty(); }
  // The view opposite to `view`; every set is symmetric: directions()[antipode(v)] == -directions()[v], bit for bit.
  int antipode(int view) const { return antipodes_[static_cast<size_t>(view)]; }
  // Views that lie near each other share a group (a page of the pack holds a group); groups are numbered from 0.
  int group(int view) const { return groups_[static_cast<size_t>(view)]; }
  int groupCount() const { return groupCount_; }

  // The view with the smallest angle to `direction` (any length but zero); on a tie the lowest index.
  int nearest(glm::dvec3 direction) const;
  // That view, and the one that would be nearest without it.
  std::array<int, 2> nearestTwo(glm::dvec3 direction) const;

  struct Triple {
    std::array<int, 3> views;       // by falling weight; on a tie the lower index first
    std::array<double, 3> weights;  // barycentric, >= 0, sum 1
  };
  // The corners of the spherical triangle `direction` passes through. REQUIRES: hasTriangles().
  Triple nearestThree(glm::dvec3 direction) const;

 private:
  Viewpoints() = default;
  void pairAntipodes();
  void groupViews();

  std::vector<glm::dvec3> directions_;
  // The triangles of the icosahedron, then of each subdivision: 4 i to 4 i + 3 are parts of triangle i of the level
  // before.
  std::vector<std::vector<std::array<int, 3>>> levels_;
  std::vector<int> antipodes_;
  std::vector<int> groups_;
  int groupCount_ = 0;
};

}  // namespace farcell
