#include "runtime/draw/impostor_instance.h"

#include <cmath>

#include "cache/schema/view_frame.h"

namespace farcell {
namespace {

glm::vec4 plane(glm::dvec3 axis, double offset) { return glm::vec4(glm::vec3(axis), static_cast<float>(offset)); }

}  // namespace

shared::ImpostorInstance makeImpostorInstance(const Model& model, const CellRecord& cell, const ImpostorViews& views,
                                              uint8_t shares, const FrameCamera& camera) {
  const double texel = texelSize(cell.form.imageSize);
  const GridBox cube = cellBox(model.grid, cell.key);
  const glm::dvec3 centreSteps = glm::dvec3(cube.min + cube.max) * 0.5;
  const double halfSteps = std::ldexp(0.5, model.grid.bits - static_cast<int>(cell.key.level));
  const glm::dvec3 eye = (camera.eyeSteps - centreSteps) / halfSteps;
  const double halfRootSides = std::ldexp(0.5, -static_cast<int>(cell.key.level));

  shared::ImpostorInstance instance;
  instance.centre = plane(centreSteps - camera.eyeSteps, halfSteps);
  instance.boxMin = plane((glm::dvec3(cell.content.min) - centreSteps) / halfSteps, texel);
  instance.boxMax = plane((glm::dvec3(cell.content.max) - centreSteps) / halfSteps, shares);
  instance.eye = plane(eye, std::log2(camera.pixelAngle / (texel * halfRootSides)) + shared::kLodBias);
  instance.tint = glm::vec4(0.0f, 0.0f, 0.0f, static_cast<float>(cell.form.imageSize));
  for (size_t i = 0; i < views.size(); ++i) {
    const DirectedView& directed = views[i];
    instance.views[i] = impostorView(directed.view, directed.direction, directed.weight, eye, texel);
  }
  return instance;
}

}  // namespace farcell
