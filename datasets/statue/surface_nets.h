// A closed triangle mesh around a field.
#pragma once

#include <functional>
#include <glm/vec3.hpp>

#include "datasets/statue/base_mesh.h"

namespace farcell {

struct Field {
  glm::dvec3 min{0};  // outside the body on every face of this box
  glm::dvec3 max{0};
  std::function<double(glm::dvec3)> distance;  // negative inside
  std::function<std::array<uint8_t, 3>(glm::dvec3)> colour;
};

// Surface nets (Gibson, Constrained Elastic Surface Nets, 1998): a vertex in each cube of edge `cellEdge` the surface
// passes, a quad across each lattice edge it cuts. Closed; vertices are moved onto the surface within their cubes.
// Corners go round counter-clockwise seen from outside.
Result<BaseMesh> surfaceNets(const Field& field, double cellEdge, int threads);

}  // namespace farcell
