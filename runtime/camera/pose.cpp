#include "runtime/camera/pose.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

namespace farcell {
namespace {

constexpr double kRightAngle = std::numbers::pi / 2;
// A camera's target lies at least this share of the eye's coordinates away: nearer, the direction to it would be
// rounded.
constexpr double kLeastReach = 1e-6;
// Squares of distances stay finite and above zero.
constexpr double kLeastDistance = 1e-150;
constexpr double kMostDistance = 1e150;

// Where yaw 0 looks: horizontal, the same for the same up axis.
glm::dvec3 northOf(glm::dvec3 up) {
  int least = 0;
  for (int axis = 1; axis < 3; ++axis)
    if (std::abs(up[axis]) < std::abs(up[least])) least = axis;
  glm::dvec3 world(0);
  world[least] = 1;
  return glm::normalize(world - up * glm::dot(world, up));
}

double clampedPitch(double pitchRad) { return std::clamp(pitchRad, -kRightAngle, kRightAngle); }

CameraPose withPivot(CameraPose pose, glm::dvec3 pivot) {
  pose.eye = pivot + axesOf(pose).back * pose.distance;
  return pose;
}

}  // namespace

CameraPose poseOf(const Camera& camera) {
  const CameraAxes axes = cameraAxes(camera);
  CameraPose pose;
  pose.eye = camera.position;
  pose.up = glm::normalize(camera.up / std::max({std::abs(camera.up.x), std::abs(camera.up.y), std::abs(camera.up.z)}));
  pose.fovYRad = camera.fovYRad;
  pose.distance = std::clamp(glm::length(camera.target - camera.position), kLeastDistance, kMostDistance);
  // Right is horizontal for every pitch, straight up and down too.
  const glm::dvec3 north = northOf(pose.up);
  const glm::dvec3 heading = glm::cross(pose.up, axes.right);
  pose.yawRad = std::atan2(glm::dot(heading, glm::cross(pose.up, north)), glm::dot(heading, north));
  pose.pitchRad = std::atan2(-glm::dot(axes.back, pose.up), -glm::dot(axes.back, heading));
  pose.pitchRad = clampedPitch(pose.pitchRad);
  return pose;
}

Camera cameraOf(const CameraPose& pose) {
  const CameraAxes axes = axesOf(pose);
  const double coordinates = std::max({std::abs(pose.eye.x), std::abs(pose.eye.y), std::abs(pose.eye.z)});
  const double reach = std::max(pose.distance, kLeastReach * coordinates);
  // Straight up or down, `up` alone would not say where right is.
  const bool vertical = std::abs(std::cos(pose.pitchRad)) < 1e-6;
  return {"view", pose.eye, pose.eye - axes.back * reach, vertical ? axes.up : pose.up, pose.fovYRad};
}

CameraAxes axesOf(const CameraPose& pose) {
  const glm::dvec3 north = northOf(pose.up);
  const glm::dvec3 west = glm::cross(pose.up, north);
  const glm::dvec3 heading = std::cos(pose.yawRad) * north + std::sin(pose.yawRad) * west;
  CameraAxes axes;
  axes.back = -(std::cos(pose.pitchRad) * heading + std::sin(pose.pitchRad) * pose.up);
  axes.right = glm::cross(heading, pose.up);
  axes.up = glm::cross(axes.back, axes.right);
  return axes;
}

glm::dvec3 pivotOf(const CameraPose& pose) { return pose.eye - axesOf(pose).back * pose.distance; }

glm::dvec3 rayThrough(const CameraPose& pose, glm::dvec2 onScreen, double aspect) {
  const CameraAxes axes = axesOf(pose);
  const double tanY = std::tan(pose.fovYRad / 2);
  return glm::normalize(axes.right * (onScreen.x * tanY * aspect) + axes.up * (onScreen.y * tanY) - axes.back);
}

CameraPose looked(CameraPose pose, double yawRad, double pitchRad) {
  pose.yawRad += yawRad;
  pose.pitchRad = clampedPitch(pose.pitchRad + pitchRad);
  return pose;
}

CameraPose orbited(CameraPose pose, double yawRad, double pitchRad) {
  return withPivot(looked(pose, yawRad, pitchRad), pivotOf(pose));
}

CameraPose panned(CameraPose pose, glm::dvec2 halfHeights) {
  const CameraAxes axes = axesOf(pose);
  const double halfHeight = std::tan(pose.fovYRad / 2) * pose.distance;
  pose.eye += (axes.right * halfHeights.x + axes.up * halfHeights.y) * halfHeight;
  return pose;
}

CameraPose dollied(CameraPose pose, glm::dvec3 point, double scale) {
  pose.eye = point + (pose.eye - point) * scale;
  pose.distance *= scale;
  return pose;
}

CameraPose fitted(CameraPose pose, const Sphere& ball, double aspect) {
  constexpr double kMargin = 1.03;
  const double halfY = pose.fovYRad / 2;
  const double narrower = std::min(halfY, std::atan(std::tan(halfY) * aspect));
  pose.distance = kMargin * ball.radius / std::sin(narrower);
  return withPivot(pose, ball.centre);
}

}  // namespace farcell
