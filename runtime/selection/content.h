// Where a model's surface is, as far as the boxes of its cells tell without reading a page: what controls scale by.
#pragma once

#include <glm/vec3.hpp>
#include <optional>

#include "cache/pack/directory.h"

namespace farcell {

// From a point of the world to the nearest content box of a leaf; 0 inside one. REQUIRES: a finite point.
double distanceToContent(const Directory& directory, glm::dvec3 point);

// Along a ray of a unit direction to where it enters the first content box of a leaf; boxes that hold the eye do not
// count, for the surface may be anywhere in them. Nothing where it meets none.
std::optional<double> distanceAlong(const Directory& directory, glm::dvec3 eye, glm::dvec3 direction);

}  // namespace farcell
