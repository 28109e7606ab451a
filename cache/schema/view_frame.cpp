#include "cache/schema/view_frame.h"

#include <glm/geometric.hpp>

namespace farcell {

ViewFrame viewFrame(glm::dvec3 direction) {
  int least = 0;
  for (int axis = 1; axis < 3; ++axis)
    if (std::abs(direction[axis]) < std::abs(direction[least])) least = axis;
  glm::dvec3 reference(0);
  reference[least] = 1;
  const glm::dvec3 right = glm::normalize(glm::cross(reference, direction));
  return {right, glm::cross(direction, right), direction};
}

}  // namespace farcell
