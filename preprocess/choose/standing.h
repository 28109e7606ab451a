// From where the runtime draws a cell as an impostor: what decides which of its views somebody can get.
#pragma once

#include <glm/vec3.hpp>

#include "cache/pack/directory.h"

namespace farcell {

// Grid steps from the grid's origin. runtime/selection/selection.cpp chooses by the direction from `centre`, and draws
// an inner cell's views only from outside the bounding sphere of its cube. A leaf's, where the triangle budget is
// spent, from anywhere; but a leaf in whose content box the eye lies comes first for triangles, so that its views are
// wanted from outside that box only (not in the mode that draws no triangles: there, such a leaf may lack the view).
struct Standing {
  glm::dvec3 centre{0};      // of the content
  glm::dvec3 halfExtent{0};  // of the content
  bool leaf = true;
  glm::dvec3 sphereCentre{0};
  double sphereRadius = 0;
};

// REQUIRES: a cell with content.
Standing standingAround(const Grid& grid, const CellRecord& cell);

}  // namespace farcell
