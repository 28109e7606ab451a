// How large the root cube is. The octree halves it, so that its leaves can have one of few sizes: in a cube just around
// the model they may come out with a quarter of the triangles that a leaf may have, and views cost the same for each.
// A cube up to twice as large shifts those sizes; the one that needs the fewest cells is found on a sample.
#pragma once

#include <vector>

#include "cache/schema/model.h"

namespace farcell {

// Of a stream of triangles every 2^k-th, as many as fit.
class TriangleSample {
 public:
  static constexpr size_t kMostPoints = size_t{1} << 16;

  void add(glm::dvec3 point) {
    if ((seen_++ & (stride_ - 1)) == 0) keep(point);
  }
  const std::vector<glm::dvec3>& points() const { return points_; }
  // Triangles that a point stands for.
  uint64_t stride() const { return stride_; }

 private:
  void keep(glm::dvec3 point);

  std::vector<glm::dvec3> points_;
  uint64_t seen_ = 0;
  uint64_t stride_ = 1;
};

// Around the centre of the smallest cube, which it is itself where no larger one has fewer cells, and for settings
// that fix the leaves' level. The sample's points lie in the smallest cube.
Grid rootCube(const Grid& smallest, const TriangleSample& sample, const BuildSettings& settings);

}  // namespace farcell
