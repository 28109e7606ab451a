// A camera in the numbers the shaders work with: grid steps from the eye, whatever the model's scale and offset.
#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "cache/pack/directory.h"
#include "runtime/camera/light.h"
#include "runtime/selection/selection.h"
#include "shaders/shared/draw.h"

namespace farcell {

struct FrameCamera {
  shared::FrameUniforms uniforms;
  glm::dvec3 eyeSteps{0};  // the eye on the grid, in steps from its origin
  double pixelAngle = 0;   // edge of a pixel at distance 1 along the view axis
};

struct FrameView {
  int width = 0;
  int height = 0;
  glm::dvec2 jitterPx{0};  // the picture is moved by this many pixels (x right, y up)
  int samples = 1;         // of a pixel
  Light light;
  double dither = 0;  // [0, 1), of a pass: what is by chance is otherwise in another
};

// The near plane is half way to the nearest content box of the cut, and not nearer than 2^-20 of the root's side:
// closer, the depth of a triangle that reaches from there to far away would drown in float32.
FrameCamera makeFrameCamera(const Directory& directory, const Camera& camera, const FrameView& view, const Cut& cut);

}  // namespace farcell
