// What a frame is lit by (shading.h): one direction for all of it.
#pragma once

#include <glm/vec3.hpp>
#include <optional>
#include <string>

#include "cache/base/result.h"
#include "cache/schema/model.h"
#include "runtime/camera/camera.h"

namespace farcell {

enum class LightKind {
  sun,
  // On the viewer's head and as far away as a sun: along the view axis, not along each ray, so that a flat face has one
  // light and a frame one direction, as with a sun.
  headlight,
};

struct Light {
  LightKind kind = LightKind::sun;
  std::optional<Sun> sun;  // of kind sun; nothing: the pack's own
  bool operator==(const Light&) const = default;
};

// Towards the light, unit, world axes.
glm::vec3 lightDirection(const Light& light, const BuildSettings& settings, const Camera& camera);

// invalidArgument, naming the pack, where its views are lit already and by another light.
Result<> checkLight(const Light& light, const BuildSettings& settings, const std::string& pack);

// The sun turned around the model and raised: around and around, not beyond straight above or below.
Light movedSun(const Light& light, const BuildSettings& settings, double azimuthRad, double elevationRad);

// "sun 39.8056,41.8685" or "headlight".
std::string lightText(const Light& light, const BuildSettings& settings);

}  // namespace farcell
