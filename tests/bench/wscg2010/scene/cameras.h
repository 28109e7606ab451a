// Where the errors are measured from.
#pragma once

#include <string>
#include <vector>

#include "runtime/camera/camera.h"
#include "tests/bench/wscg2010/scene/scene.h"

namespace farcell::wscg {

inline constexpr double kReferenceFovDeg = 40;  // the paper's, of the whole height

// Looks at the centre of the bounding sphere from `distance` diameters beyond its surface, along `direction` (unit,
// from the centre to the viewer).
Camera orbitCamera(const Scene& scene, glm::dvec3 direction, double distance, double fovDeg = kReferenceFovDeg);

// Directions in which every set of 80, 320 and 1280 images has a gap: vertices of the icosahedron split once are
// corners of the triangles whose centres those sets use. `count` of them near the horizon (0 to 35 degrees), spread
// out.
std::vector<glm::dvec3> levelDirections(const Scene& scene, int count);
// The same, 45 to 75 degrees above it: the paper's "vertical component greater".
glm::dvec3 steepDirection(const Scene& scene);

struct ErrorCamera {
  Camera camera;
  double distance = 0;  // diameters
  bool steep = false;
};
std::vector<ErrorCamera> errorCameras(const Scene& scene, const std::vector<double>& distances, int levelCount);

}  // namespace farcell::wscg
