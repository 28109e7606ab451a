#include "runtime/camera/overview.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

namespace farcell {
namespace {
constexpr double kDegree = std::numbers::pi / 180;
constexpr double kFovYRad = 40 * kDegree;
constexpr double kMargin = 1.05;
constexpr double kElevationRad = 30 * kDegree;
constexpr double kAzimuthRad = 35 * kDegree;  // off the axes: no face is seen edge-on
}  // namespace

Camera overviewCamera(glm::dvec3 min, glm::dvec3 max, glm::dvec3 up, double aspect) {
  const glm::dvec3 side(up.z, up.x, up.y);
  const glm::dvec3 other = glm::cross(up, side);
  const glm::dvec3 toward = up * std::sin(kElevationRad) +
                            std::cos(kElevationRad) * (std::sin(kAzimuthRad) * side - std::cos(kAzimuthRad) * other);
  Camera camera{"overview", {}, min * 0.5 + max * 0.5, up, kFovYRad};
  const CameraAxes axes = cameraAxes({"", toward, glm::dvec3(0), up, kFovYRad});
  const double tanY = std::tan(kFovYRad / 2);
  double distance = 0;
  for (int i = 0; i < 8; ++i) {
    const glm::dvec3 corner(i & 1 ? max.x : min.x, i & 2 ? max.y : min.y, i & 4 ? max.z : min.z);
    const glm::dvec3 v = corner - camera.target;
    const double depthNeeded =
        std::max(std::abs(glm::dot(v, axes.right)) / (tanY * aspect), std::abs(glm::dot(v, axes.up)) / tanY);
    distance = std::max(distance, glm::dot(v, axes.back) + depthNeeded * kMargin);
  }
  camera.position = camera.target + toward * std::max(distance, 1e-300);
  return camera;
}

}  // namespace farcell
