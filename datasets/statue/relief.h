// Where the vertices of a fine statue lie.
#pragma once

#include "datasets/ply/ply_output.h"
#include "datasets/statue/base_mesh.h"
#include "datasets/statue/stone.h"
#include "datasets/statue/subdivision.h"

namespace farcell {

class Relief {
 public:
  // `base` must outlive it.
  Relief(const BaseMesh& base, const StoneSettings& stone) : base_(base), stone_(stone) {}

  // In the coordinates the base came in.
  PlyVertex vertex(const SurfacePoint& point) const;

 private:
  const BaseMesh& base_;
  Stone stone_;
};

}  // namespace farcell
