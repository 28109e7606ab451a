#include "runtime/draw/impostor_instance.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "cache/schema/view_frame.h"

namespace farcell {
namespace {

constexpr double kLodBias = -0.75;       // sharper than the pixel's footprint asks: measured best
constexpr double kViewPadTexels = 1;     // around the crop, for filtered edges
constexpr double kDepthPadTexels = 0.5;  // before and behind what the view holds: flat cells have no depth at all
constexpr double kDepthSteps = 254;      // between depth value 1 and 255 (pages.h)

// Depth values as a linear function of w, in half sides.
struct DepthScale {
  double perHalfSide;
  double valueAtZero;
};

DepthScale depthScale(const ResidentView& view, double texel) {
  // A view of one depth still needs a slope: values then stay within a small part of a texel.
  const double range = std::max(static_cast<double>(view.depthMax) - view.depthMin, texel * 1e-2);
  const double slope = kDepthSteps / range;
  return {slope, 1 - view.depthMin * slope};
}

glm::vec4 plane(glm::dvec3 axis, double offset) { return glm::vec4(glm::vec3(axis), static_cast<float>(offset)); }

// eye: local.
shared::ImpostorView impostorView(const DirectedView& directed, glm::dvec3 eye, double texel) {
  const ResidentView& view = directed.view;
  const ViewFrame frame = viewFrame(directed.direction);
  const DepthScale depth = depthScale(view, texel);
  const double depthTexel = texel * depth.perHalfSide;
  const double middle = kViewHalfExtent / texel;
  const glm::dvec3 eyeTexture(glm::dot(frame.right, eye) / texel + middle, glm::dot(frame.up, eye) / texel + middle,
                              glm::dot(frame.toward, eye) * depth.perHalfSide + depth.valueAtZero);
  shared::ImpostorView result;
  result.textureX = plane(frame.right / texel, middle);
  result.textureY = plane(frame.up / texel, middle);
  result.textureZ = plane(frame.toward * depth.perHalfSide, depth.valueAtZero);
  result.eye = plane(eyeTexture, depthTexel);
  result.boxMin = glm::vec4(1, 1, 1, 0);
  result.boxMax = glm::vec4(0);
  if (view.layer < 0) return result;
  const glm::dvec2 cropMin(view.x0, view.y0);
  const glm::dvec2 cropMax(view.x0 + view.width, view.y0 + view.height);
  const double depthMaxValue = (static_cast<double>(view.depthMax) - view.depthMin) * depth.perHalfSide + 1;
  result.boxMin = plane({cropMin - kViewPadTexels, 1 - kDepthPadTexels * depthTexel}, view.layer);
  result.boxMax = plane({cropMax + kViewPadTexels, depthMaxValue + kDepthPadTexels * depthTexel}, directed.weight);
  return result;
}

}  // namespace

shared::ImpostorInstance makeImpostorInstance(const Model& model, const CellRecord& cell, const ImpostorViews& views,
                                              uint8_t shares, const FrameCamera& camera) {
  const double texel = texelSize(model.settings.imageSize);
  const GridBox cube = cellBox(model.grid, cell.key);
  const glm::dvec3 centreSteps = glm::dvec3(cube.min + cube.max) * 0.5;
  const double halfSteps = std::ldexp(0.5, model.grid.bits - static_cast<int>(cell.key.level));
  const glm::dvec3 eye = (camera.eyeSteps - centreSteps) / halfSteps;
  const double halfRootSides = std::ldexp(0.5, -static_cast<int>(cell.key.level));

  shared::ImpostorInstance instance;
  instance.centre = plane(centreSteps - camera.eyeSteps, halfSteps);
  instance.boxMin = plane((glm::dvec3(cell.content.min) - centreSteps) / halfSteps, texel);
  instance.boxMax = plane((glm::dvec3(cell.content.max) - centreSteps) / halfSteps, shares);
  instance.eye = plane(eye, std::log2(camera.pixelAngle / (texel * halfRootSides)) + kLodBias);
  instance.tint = glm::vec4(0);
  for (size_t i = 0; i < views.size(); ++i) instance.views[i] = impostorView(views[i], eye, texel);
  return instance;
}

}  // namespace farcell
