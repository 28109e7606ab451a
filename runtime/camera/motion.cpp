#include "runtime/camera/motion.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

namespace farcell {
namespace {

// Differences that no one sees: far below a pixel.
constexpr double kRestRad = 1e-5;
constexpr double kRestShare = 1e-6;  // of the distance

glm::dvec3 anchorOf(const CameraPose& pose, Anchor anchor) { return anchor == Anchor::eye ? pose.eye : pivotOf(pose); }

// Far from the origin coordinates are rounded: places that differ by that alone are the same.
double roundingOf(glm::dvec3 place) {
  return 4 * std::numeric_limits<double>::epsilon() *
         std::max({std::abs(place.x), std::abs(place.y), std::abs(place.z)});
}

bool near(const CameraPose& a, const CameraPose& b) {
  const double angle = std::max(std::abs(a.yawRad - b.yawRad), std::abs(a.pitchRad - b.pitchRad));
  return angle < kRestRad && std::abs(std::log(a.distance / b.distance)) < kRestShare &&
         glm::length(a.eye - b.eye) <= kRestShare * std::min(a.distance, b.distance) + roundingOf(a.eye);
}

}  // namespace

// d seen / dt = (goal - seen) / T, solved exactly for a goal that moves with constant velocity v: seen runs v T behind
// it, and what else was between them dies away exponentially.
void CameraMotion::advance(double seconds, glm::dvec3 velocity, Anchor anchor) {
  if (!(seconds > 0)) return;
  const double left = std::exp(-seconds / kFollowSeconds);
  const glm::dvec3 behind = velocity * kFollowSeconds;
  const glm::dvec3 gap = anchorOf(seen_, anchor) - anchorOf(goal_, anchor);
  goal_.eye += velocity * seconds;
  const glm::dvec3 place = anchorOf(goal_, anchor) - behind + (gap + behind) * left;
  seen_.yawRad = goal_.yawRad + (seen_.yawRad - goal_.yawRad) * left;
  seen_.pitchRad = goal_.pitchRad + (seen_.pitchRad - goal_.pitchRad) * left;
  seen_.distance = goal_.distance * std::pow(seen_.distance / goal_.distance, left);
  seen_.up = goal_.up;
  seen_.fovYRad = goal_.fovYRad;
  seen_.eye = anchor == Anchor::eye ? place : place + axesOf(seen_).back * seen_.distance;
  if (velocity == glm::dvec3(0) && near(seen_, goal_)) seen_ = goal_;
}

bool CameraMotion::resting() const { return near(seen_, goal_); }

}  // namespace farcell
