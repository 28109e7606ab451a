#include "preprocess/lod/rings.h"

namespace farcell::lod {

void Rings::build(std::span<const Triangle> triangles, size_t places) {
  starts_.assign(places + 2, 0);
  for (const Triangle& triangle : triangles)
    for (const uint32_t place : triangle) ++starts_[place + 2];
  for (size_t place = 2; place < starts_.size(); ++place) starts_[place] += starts_[place - 1];
  edges_.resize(3 * triangles.size());
  // starts_[place + 1] moves from the ring's begin to its end while the ring is filled.
  for (size_t t = 0; t < triangles.size(); ++t)
    for (size_t k = 0; k < 3; ++k)
      edges_[starts_[triangles[t][k] + 1]++] = {triangles[t][(k + 1) % 3], triangles[t][(k + 2) % 3],
                                                static_cast<uint32_t>(t)};
}

}  // namespace farcell::lod
