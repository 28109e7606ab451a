// Rays of a camera, in double: pixel (0, 0) is the top left one, its centre at (.5, .5); pixels are square.
#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <optional>

#include "runtime/camera/camera.h"

namespace farcell {

struct ReferenceView {
  int width = 0;
  int height = 0;
  glm::dvec3 eye{0};
  CameraAxes axes{};
  double pixelSize = 0;  // edge of a pixel at distance 1 along the view direction
};

ReferenceView referenceView(const Camera& camera, int width, int height);

// World direction through a screen point; its part along the view direction is 1, so that eye + d * direction has depth
// d.
glm::dvec3 rayDirection(const ReferenceView& view, glm::dvec2 screen);

// Pixels [x0, x1) x [y0, y1), within the image.
struct ScreenBounds {
  int x0 = 0, y0 = 0, x1 = 0, y1 = 0;
  double nearestDepth = 0;  // of the box; 0 when the eye's plane cuts it
};
// A rectangle around every ray that can meet the world box [min, max]; nothing when none can.
std::optional<ScreenBounds> screenBounds(const ReferenceView& view, glm::dvec3 min, glm::dvec3 max);

// Where sample `index` of perAxis^2 lies in its pixel, in [0, 1)^2: a regular grid, jittered within its squares by a
// hash of pixel and index. The same for every camera and run.
glm::dvec2 samplePosition(int x, int y, int index, int perAxis);

}  // namespace farcell
