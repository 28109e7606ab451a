// The separate parts of a cell's mesh - buildings, leaves of a tree, loose triangles - and how many become few without
// the picture growing thinner: of small parts some are kept, and each of those is enlarged to the area of those that it
// stands for. After Cook, Halstead, Planck, Ryu, Stochastic Simplification of Aggregate Detail, 2007; which ones are
// kept is decided by systematic sampling along the Morton curve, with a probability as large as the part's area, so
// that neighbours stand for neighbours and no area is lost. The geometric error stays small in both directions: of each
// cube of a grid as fine as the parts that may go, one is kept, and what one cannot grow by the next ones do.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "preprocess/lod/collapse.h"
#include "preprocess/lod/welded_mesh.h"

namespace farcell::lod {

class Parts {
 public:
  // The mesh must outlive this.
  explicit Parts(const WeldedMesh& mesh);

  size_t count() const { return areas_.size(); }
  // Whether any part may be taken away: one that touches a face of the cell's cube stays.
  bool anyFree() const { return anyFree_; }
  // Of a place: the error that its collapse may have, `share` of the root of its part's area.
  std::vector<float> limitsSteps(double share) const;
  // Takes away free parts of less than areaSteps2 (of what they stand for, squared steps), as few as leave `target`
  // triangles. False if it took none.
  bool thin(Collapser& collapser, double areaSteps2, size_t target);
  // The places, parts that lost area or stand for others enlarged about their middles, inside the cube.
  std::vector<GridPoint> enlarged(const std::vector<Triangle>& triangles) const;
  size_t taken() const { return taken_; }

 private:
  struct Member {
    uint32_t part;
    size_t triangles;
  };
  template <class Visit>
  double sample(const std::vector<Member>& members, double least, int cubeLevel, const Visit& visit) const;
  std::vector<Member> freeMembers(const std::vector<Triangle>& triangles) const;
  const Member* loneOf(std::span<const Member> cube, double least, double waiting) const;
  int cubeLevel(double least) const;

  const WeldedMesh& mesh_;
  std::vector<uint32_t> partOf_;  // of a place; kNone: of no triangle
  std::vector<double> areas_;     // that the part stands for, squared steps
  std::vector<double> ownAreas_;
  std::vector<double> sizesSteps_;  // diagonals of the parts' boxes
  std::vector<uint64_t> codes_;     // Morton code of its middle in the cell
  std::vector<bool> free_;
  bool anyFree_ = false;
  double freeArea_ = 0;
  size_t taken_ = 0;
  double leastArea_ = 0;  // that a part had to have to stay, squared steps
};

}  // namespace farcell::lod
