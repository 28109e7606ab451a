#include "runtime/camera/light.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace farcell {
namespace {

constexpr double kSameRad = 1e-5;  // no channel of a picture tells such suns apart

Sun sunOf(const Light& light, const BuildSettings& settings) { return light.sun.value_or(settings.sun); }

bool isBaked(const Light& light, const BuildSettings& settings) {
  const Sun sun = sunOf(light, settings);
  return light.kind == LightKind::sun && std::abs(sun.azimuthRad - settings.sun.azimuthRad) < kSameRad &&
         std::abs(sun.elevationRad - settings.sun.elevationRad) < kSameRad;
}

}  // namespace

glm::vec3 lightDirection(const Light& light, const BuildSettings& settings, const Camera& camera) {
  if (light.kind == LightKind::headlight) return glm::vec3(cameraAxes(camera).back);
  return sunDirection(settings.up, sunOf(light, settings));
}

Result<> checkLight(const Light& light, const BuildSettings& settings, const std::string& pack) {
  if (settings.lighting == Lighting::relightable || isBaked(light, settings)) return {};
  return fail(ErrorKind::invalidArgument,
              "{}: its views were baked under the sun {}; for {} build it with --lighting relightable", pack,
              sunText(settings.sun), lightText(light, settings));
}

Light movedSun(const Light& light, const BuildSettings& settings, double azimuthRad, double elevationRad) {
  Sun sun = sunOf(light, settings);
  sun.azimuthRad = std::remainder(sun.azimuthRad + azimuthRad, 2 * std::numbers::pi);
  sun.elevationRad = std::clamp(sun.elevationRad + elevationRad, -std::numbers::pi / 2, std::numbers::pi / 2);
  return {LightKind::sun, sun};
}

std::string lightText(const Light& light, const BuildSettings& settings) {
  return light.kind == LightKind::headlight ? "headlight" : fmt::format("sun {}", sunText(sunOf(light, settings)));
}

}  // namespace farcell
