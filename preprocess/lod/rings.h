// Which triangles surround a place.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "preprocess/lod/welded_mesh.h"

namespace farcell::lod {

// The two other corners of a triangle, in its order.
struct RingEdge {
  uint32_t next, previous;
  uint32_t triangle;
};

class Rings {
 public:
  void build(std::span<const Triangle> triangles, size_t places);
  std::span<const RingEdge> of(uint32_t place) const {
    return {edges_.data() + starts_[place], edges_.data() + starts_[place + 1]};
  }

 private:
  std::vector<uint32_t> starts_;
  std::vector<RingEdge> edges_;
};

}  // namespace farcell::lod
