// The distance of a point from a mesh: a tree of boxes over triangles in Morton order, four to a node.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "preprocess/lod/welded_mesh.h"

namespace farcell::lod {

// Ericson, Real-Time Collision Detection, 2005, section 5.1.5. Squared; exact up to rounding for slivers too.
double squareDistance(glm::dvec3 point, glm::dvec3 a, glm::dvec3 b, glm::dvec3 c);

struct Nearest {
  double square;  // squared distance
  uint32_t triangle;
};

class TriangleTree {
 public:
  // Both must outlive this.
  TriangleTree(std::span<const GridPoint> places, std::span<const Triangle> triangles);

  // The nearest triangle, the first with `known` if none is nearer; any whose square is at most `enough` will do.
  Nearest nearest(glm::dvec3 point, double known, double enough) const;

 private:
  struct Box {
    glm::ivec3 min{INT32_MAX}, max{INT32_MIN};
    double squareDistance(glm::dvec3 point) const;
  };
  std::span<const GridPoint> places_;
  std::span<const Triangle> triangles_;
  std::vector<uint32_t> order_;           // Morton order of the triangles
  std::vector<std::vector<Box>> levels_;  // levels_[0]: of four triangles each; the last: one box
};

}  // namespace farcell::lod
