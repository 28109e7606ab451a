// A perspective camera in world coordinates.
#pragma once

#include <filesystem>
#include <glm/vec3.hpp>
#include <string>
#include <vector>

#include "cache/base/result.h"

namespace farcell {

struct Camera {
  std::string name;
  glm::dvec3 position{0};
  glm::dvec3 target{0, 0, -1};
  glm::dvec3 up{0, 1, 0};
  double fovYRad = 0.7;  // of the whole height
  bool operator==(const Camera&) const = default;
};

// Orthonormal axes of the view: x right, y up, z backwards (the eye looks along -z).
struct CameraAxes {
  glm::dvec3 right, up, back;
};
// An up vector parallel to the view direction is replaced by the world axis the direction leans on least.
CameraAxes cameraAxes(const Camera& camera);

// {"cameras":[{"name","position":[x,y,z],"target":[x,y,z],"up":[0,0,1],"fovYDeg":40}]}; doubles, world coordinates.
// Errors name the file, the camera and the member; finite numbers, fovYDeg in (0, 180), target != position are
// required.
Result<std::vector<Camera>> readCameras(const std::filesystem::path& path);
Result<std::vector<Camera>> parseCameras(const std::string& json, const std::string& name);
// Text that parseCameras reads back. REQUIRES: a camera that it would accept.
std::string camerasJson(const std::vector<Camera>& cameras);

}  // namespace farcell
