#include "cache/schema/model.h"

#include <glm/geometric.hpp>

namespace farcell {
namespace {

struct UnitName {
  std::string_view name;
  double metres;
};
constexpr std::array<UnitName, 6> kUnits = {
    {{"mm", 0.001}, {"cm", 0.01}, {"m", 1}, {"km", 1000}, {"in", 0.0254}, {"ft", 0.3048}}};

}  // namespace

std::optional<UpAxis> upAxisNamed(std::string_view name) {
  if (name == "x") return UpAxis::x;
  if (name == "y") return UpAxis::y;
  if (name == "z") return UpAxis::z;
  return std::nullopt;
}

std::optional<double> metresOfUnit(std::string_view name) {
  for (const UnitName& unit : kUnits)
    if (unit.name == name) return unit.metres;
  return std::nullopt;
}

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
