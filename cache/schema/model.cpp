#include "cache/schema/model.h"

#include <glm/geometric.hpp>

namespace farcell {

glm::dvec3 upVector(UpAxis up) {
  glm::dvec3 result(0);
  result[static_cast<int>(up)] = 1;
  return result;
}

glm::vec3 sunDirection(UpAxis up) {
  glm::dvec3 sun;
  const int axis = static_cast<int>(up);
  sun[axis] = 0.7;
  sun[(axis + 1) % 3] = 0.6;
  sun[(axis + 2) % 3] = 0.5;
  return glm::vec3(glm::normalize(sun));
}

}  // namespace farcell
