#include "cache/pack/view_space.h"

#include <algorithm>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>

#include "cache/schema/view_frame.h"

namespace farcell {
namespace {

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

}  // namespace

ResidentView residentView(const ViewImage& image, int layer) {
  return {image.width > 0 ? layer : -1, image.x0, image.y0, image.width, image.height, image.depthMin, image.depthMax};
}

shared::ImpostorView impostorView(const ResidentView& view, glm::dvec3 direction, double weight, glm::dvec3 eye,
                                  double texel) {
  const ViewFrame frame = viewFrame(direction);
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
  result.boxMin = plane(glm::dvec3(cropMin - kViewPadTexels, 1 - kDepthPadTexels * depthTexel), view.layer);
  result.boxMax = plane(glm::dvec3(cropMax + kViewPadTexels, depthMaxValue + kDepthPadTexels * depthTexel), weight);
  return result;
}

}  // namespace farcell
