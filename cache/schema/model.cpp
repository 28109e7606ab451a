#include "cache/schema/model.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/trigonometric.hpp>
#include <numbers>

namespace farcell {
namespace {

struct UnitName {
  std::string_view name;
  double metres;
};
constexpr std::array<UnitName, 6> kUnits = {
    {{"mm", 0.001}, {"cm", 0.01}, {"m", 1}, {"km", 1000}, {"in", 0.0254}, {"ft", 0.3048}}};

}  // namespace

namespace {
constexpr std::array<const char*, 3> kFormsNames = {"fixed", "chosen", "by-height"};
}

std::optional<Forms> formsNamed(std::string_view name) {
  const auto found = std::find(kFormsNames.begin(), kFormsNames.end(), name);
  if (found == kFormsNames.end()) return std::nullopt;
  return static_cast<Forms>(found - kFormsNames.begin());
}
const char* formsName(Forms forms) { return kFormsNames.at(static_cast<size_t>(forms)); }

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

bool isSun(const Sun& sun) {
  return std::abs(sun.azimuthRad) <= 2 * std::numbers::pi && std::abs(sun.elevationRad) <= std::numbers::pi / 2;
}

std::string sunText(const Sun& sun) {
  return fmt::format("{:.6g},{:.6g}", glm::degrees(sun.azimuthRad), glm::degrees(sun.elevationRad));
}

glm::vec3 sunDirection(UpAxis up, const Sun& sun) {
  glm::dvec3 direction;
  const int axis = static_cast<int>(up);
  direction[axis] = std::sin(sun.elevationRad);
  direction[(axis + 1) % 3] = std::cos(sun.elevationRad) * std::cos(sun.azimuthRad);
  direction[(axis + 2) % 3] = std::cos(sun.elevationRad) * std::sin(sun.azimuthRad);
  return glm::vec3(direction);
}

}  // namespace farcell
