// What lies behind the model in a window, and the pass that lays a frame over it.
#pragma once

#include <array>
#include <cstdint>

#include "cache/base/result.h"
#include "runtime/camera/camera.h"
#include "runtime/draw/frame_target.h"
#include "runtime/gl/program.h"

namespace farcell {

// Colours by the direction looked in; display values.
struct Backdrop {
  std::array<uint8_t, 3> zenith;
  std::array<uint8_t, 3> horizon;
  std::array<uint8_t, 3> nadir;
  bool operator==(const Backdrop&) const = default;
};
inline constexpr Backdrop kSky = {{104, 152, 208}, {224, 232, 238}, {150, 158, 164}};

class BackdropPainter {
 public:
  // REQUIRES: a current context.
  static Result<BackdropPainter> create();

  // Draws the resolved frame over the backdrop into `framebuffer`, whose size is the frame's; `share` of the result is
  // mixed with 1 - share of what is there. `up` is the unit vector the backdrop is upright by.
  void paint(const FrameTarget& frame, const Backdrop& backdrop, const Camera& camera, glm::dvec3 up, double share,
             GLuint framebuffer) const;

 private:
  explicit BackdropPainter(GlProgram program) : program_(std::move(program)), bare_(createVertexArray()) {}
  GlProgram program_;
  GlVertexArray bare_;  // corners come from gl_VertexID
};

}  // namespace farcell
