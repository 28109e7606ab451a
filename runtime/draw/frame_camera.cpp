#include "runtime/draw/frame_camera.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace farcell {
namespace {

constexpr double kMaxEyeSteps = 1e30;            // squares stay finite in float
constexpr double kMaxIntegerSteps = 1073741824;  // 2^30: differences to grid points fit 32 bits
constexpr double kMinNear = 1.0 / (1 << 20);     // root sides

glm::vec4 row(glm::dvec3 v) { return glm::vec4(glm::vec3(v), 0.0f); }

}  // namespace

FrameCamera makeFrameCamera(const Directory& directory, const Camera& camera, const FrameView& view, const Cut& cut) {
  const Model& model = directory.model;
  const CameraAxes axes = cameraAxes(camera);
  const double tanY = std::tan(camera.fovYRad / 2);
  const double tanX = tanY * view.width / view.height;
  const double rootSidesPerStep = std::ldexp(1.0, -model.grid.bits);
  FrameCamera frame;
  frame.pixelAngle = 2 * tanY / view.height;
  glm::ivec3 whole;
  glm::dvec3 fraction;
  for (int axis = 0; axis < 3; ++axis) {
    frame.eyeSteps[axis] =
        std::clamp((camera.position[axis] - model.grid.origin[axis]) / model.grid.step(), -kMaxEyeSteps, kMaxEyeSteps);
    whole[axis] = static_cast<int>(std::floor(std::clamp(frame.eyeSteps[axis], -kMaxIntegerSteps, kMaxIntegerSteps)));
    fraction[axis] = frame.eyeSteps[axis] - whole[axis];
  }
  const glm::dvec3 clipW = -axes.back * rootSidesPerStep;
  const glm::dvec3 clipX = axes.right * (rootSidesPerStep / tanX) + clipW * (2 * view.jitterPx.x / view.width);
  const glm::dvec3 clipY = axes.up * (rootSidesPerStep / tanY) + clipW * (2 * view.jitterPx.y / view.height);
  // The nearest content may lie in a corner of the picture, where the depth is less than the distance.
  const double cosCorner = 1 / std::sqrt(1 + tanX * tanX + tanY * tanY);
  const double nearest = std::min(cut.nearestSteps, kMaxEyeSteps) * rootSidesPerStep;
  const double near = std::max(kMinNear, 0.5 * cosCorner * nearest);
  frame.uniforms = {
      row(clipX),
      row(clipY),
      row(clipW),
      glm::ivec4(whole, 0),
      glm::vec4(glm::vec3(fraction), static_cast<float>(near)),
      glm::vec4(lightDirection(view.light, model.settings, camera), 0.0f),
      glm::vec4(static_cast<float>(std::log2(view.samples) / 2), static_cast<float>(view.dither), 0.0f, 0.0f),
      glm::vec4(0)};
  return frame;
}

}  // namespace farcell
