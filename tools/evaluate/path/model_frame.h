// A model as generated paths see it: where it is, and which way is up.
#pragma once

#include <algorithm>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "cache/schema/model.h"

namespace farcell {

struct ModelFrame {
  glm::dvec3 min, max;  // world
  glm::dvec3 centre;
  double radius = 1;           // of the bounding sphere
  glm::dvec3 up, east, north;  // unit axes of the world, none of them negative
};

inline ModelFrame modelFrame(const Model& model) {
  const glm::dvec3 min = model.grid.worldFromGrid(model.bounds.min), max = model.grid.worldFromGrid(model.bounds.max);
  const glm::dvec3 up = upVector(model.settings.up), east(up.y, up.z, up.x);
  // A model without extent still has a root cube of some size.
  return {min,
          max,
          (min + max) * 0.5,
          std::max(glm::length(max - min) * 0.5, model.grid.side * 0.25),
          up,
          east,
          glm::abs(glm::cross(up, east))};
}

}  // namespace farcell
