// An eye as a person moves it: where it is and where it looks, never rolled, whatever the order of the moves.
//
// Angles are kept, not axes, so that nothing drifts; the pivot that an orbit turns around lies straight ahead. Moves
// are pure: each returns the pose after it.
#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "runtime/camera/camera.h"

namespace farcell {

struct CameraPose {
  glm::dvec3 eye{0};
  double yawRad = 0;       // around `up`, counter-clockwise seen from above; 0 is any fixed direction
  double pitchRad = 0;     // above the horizon, in [-pi/2, pi/2]
  double distance = 1;     // from the eye to the pivot, > 0
  glm::dvec3 up{0, 0, 1};  // unit
  double fovYRad = 0.7;
};

// A ball in the world; radius > 0.
struct Sphere {
  glm::dvec3 centre{0};
  double radius = 1;
};

// The pose that looks as the camera does; its `up` becomes the axis, its target the pivot.
CameraPose poseOf(const Camera& camera);
Camera cameraOf(const CameraPose& pose);

CameraAxes axesOf(const CameraPose& pose);
glm::dvec3 pivotOf(const CameraPose& pose);
// Unit direction through a point of the picture: onScreen in -1..1, y up; aspect is width / height.
glm::dvec3 rayThrough(const CameraPose& pose, glm::dvec2 onScreen, double aspect);

// The eye stays and looks elsewhere.
CameraPose looked(CameraPose pose, double yawRad, double pitchRad);
// The pivot stays and the eye goes around it, at the same distance.
CameraPose orbited(CameraPose pose, double yawRad, double pitchRad);
// Eye and pivot move across the view: by shares of half the picture's height at the pivot's distance.
CameraPose panned(CameraPose pose, glm::dvec2 halfHeights);
// The eye comes nearer to `point`, which stays where it is on the screen; distances to it are multiplied by scale > 0.
CameraPose dollied(CameraPose pose, glm::dvec3 point, double scale);
// Looks at the ball's centre from where it just fills the picture; the direction stays.
CameraPose fitted(CameraPose pose, const Sphere& ball, double aspect);

}  // namespace farcell
