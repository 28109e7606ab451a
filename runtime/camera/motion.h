// A pose that follows another one smoothly. However a stretch of time is cut into frames, the path is the same.
#pragma once

#include "runtime/camera/pose.h"

namespace farcell {

// What moves in a straight line while the angles change: the eye of a walker, the pivot of an orbit.
enum class Anchor { eye, pivot };

// Where the person has steered to is the goal; what is seen follows it with the time constant kFollowSeconds.
class CameraMotion {
 public:
  static constexpr double kFollowSeconds = 0.07;

  explicit CameraMotion(const CameraPose& start) : goal_(start), seen_(start) {}

  const CameraPose& goal() const { return goal_; }
  const CameraPose& seen() const { return seen_; }
  void setGoal(const CameraPose& goal) { goal_ = goal; }
  // Both pivots are moved along the views; nothing is seen of it.
  void setDistance(double distance) { goal_.distance = seen_.distance = distance; }

  // Lets time pass, in which the goal moves with a velocity (world units a second) and the seen pose follows.
  void advance(double seconds, glm::dvec3 velocity, Anchor anchor);
  // Whether the seen pose is where the goal is: the picture stays until someone steers.
  bool resting() const;

 private:
  CameraPose goal_;
  CameraPose seen_;
};

}  // namespace farcell
