#include "tools/evaluate/reference/view.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <glm/geometric.hpp>

namespace farcell {
namespace {

// Box corners in view axes: x right, y up, z depth.
std::array<glm::dvec3, 8> cornersInView(const ReferenceView& view, glm::dvec3 min, glm::dvec3 max) {
  std::array<glm::dvec3, 8> corners;
  for (size_t i = 0; i < 8; ++i) {
    const glm::dvec3 world((i & 1) != 0 ? max.x : min.x, (i & 2) != 0 ? max.y : min.y, (i & 4) != 0 ? max.z : min.z);
    const glm::dvec3 p = world - view.eye;
    corners[i] = {glm::dot(p, view.axes.right), glm::dot(p, view.axes.up), -glm::dot(p, view.axes.back)};
  }
  return corners;
}

// Whether all corners lie outside one side of the frustum, by more than a pixel.
bool outsideFrustum(const ReferenceView& view, const std::array<glm::dvec3, 8>& corners) {
  const double right = (view.width / 2.0 + 1) * view.pixelSize, top = (view.height / 2.0 + 1) * view.pixelSize;
  const auto all = [&](auto&& outside) { return std::all_of(corners.begin(), corners.end(), outside); };
  return all([&](glm::dvec3 p) { return p.z <= 0; }) || all([&](glm::dvec3 p) { return p.x > right * p.z; }) ||
         all([&](glm::dvec3 p) { return -p.x > right * p.z; }) || all([&](glm::dvec3 p) { return p.y > top * p.z; }) ||
         all([&](glm::dvec3 p) { return -p.y > top * p.z; });
}

int clampedPixel(double value, int count) {
  return static_cast<int>(std::clamp(value, 0.0, static_cast<double>(count)));
}

// splitmix64 (Steele, Lea, Flood, Fast Splittable Pseudorandom Number Generators, 2014).
uint64_t mix(uint64_t value) {
  value += 0x9e3779b97f4a7c15u;
  value = (value ^ (value >> 30)) * 0xbf58476d1ce4e5b9u;
  value = (value ^ (value >> 27)) * 0x94d049bb133111ebu;
  return value ^ (value >> 31);
}

}  // namespace

ReferenceView referenceView(const Camera& camera, int width, int height) {
  return {width, height, camera.position, cameraAxes(camera), 2 * std::tan(camera.fovYRad / 2) / height};
}

glm::dvec3 rayDirection(const ReferenceView& view, glm::dvec2 screen) {
  const double x = (screen.x - view.width / 2.0) * view.pixelSize;
  const double y = (view.height / 2.0 - screen.y) * view.pixelSize;
  return view.axes.right * x + view.axes.up * y - view.axes.back;
}

std::optional<ScreenBounds> screenBounds(const ReferenceView& view, glm::dvec3 min, glm::dvec3 max) {
  const auto corners = cornersInView(view, min, max);
  if (outsideFrustum(view, corners)) return std::nullopt;
  double nearest = corners[0].z, farthest = corners[0].z;
  for (const glm::dvec3& p : corners) {
    nearest = std::min(nearest, p.z);
    farthest = std::max(farthest, p.z);
  }
  // A box that the eye's plane cuts, or nearly, projects to anywhere.
  if (nearest <= 1e-6 * farthest) return ScreenBounds{0, 0, view.width, view.height, 0};
  double x0 = INFINITY, y0 = INFINITY, x1 = -INFINITY, y1 = -INFINITY;
  for (const glm::dvec3& p : corners) {
    const double x = view.width / 2.0 + p.x / (p.z * view.pixelSize);
    const double y = view.height / 2.0 - p.y / (p.z * view.pixelSize);
    x0 = std::min(x0, x), x1 = std::max(x1, x), y0 = std::min(y0, y), y1 = std::max(y1, y);
  }
  // A hundredth of a pixel is far above any rounding here.
  const ScreenBounds bounds{
      clampedPixel(std::floor(x0 - .01), view.width), clampedPixel(std::floor(y0 - .01), view.height),
      clampedPixel(std::ceil(x1 + .01), view.width), clampedPixel(std::ceil(y1 + .01), view.height), nearest};
  if (bounds.x0 >= bounds.x1 || bounds.y0 >= bounds.y1) return std::nullopt;
  return bounds;
}

glm::dvec2 samplePosition(int x, int y, int index, int perAxis) {
  const uint64_t pixel = static_cast<uint64_t>(static_cast<uint32_t>(y)) << 32 | static_cast<uint32_t>(x);
  const uint64_t random = mix(mix(pixel) + static_cast<uint64_t>(index));
  constexpr double kScale = 1.0 / 4294967296.0;
  const double jitterX = static_cast<double>(random >> 32) * kScale;
  const double jitterY = static_cast<double>(random & 0xffffffffu) * kScale;
  return glm::dvec2(index % perAxis + jitterX, index / perAxis + jitterY) / static_cast<double>(perAxis);
}

}  // namespace farcell
