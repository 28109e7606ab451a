// What lies behind the model in a window, and the pass that lays a frame over it.
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec2.hpp>

#include "cache/base/result.h"
#include "runtime/camera/camera.h"
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

  // Draws a picture (the name of a texture, premultiplied by coverage) over the backdrop into `framebuffer`, whose size
  // is the picture's. `up` is the unit vector the backdrop is upright by.
  void paint(GLuint picture, glm::ivec2 sizePx, const Backdrop& backdrop, const Camera& camera, glm::dvec3 up,
             GLuint framebuffer) const;

 private:
  explicit BackdropPainter(GlProgram program) : program_(std::move(program)), bare_(createVertexArray()) {}
  GlProgram program_;
  GlVertexArray bare_;  // corners come from gl_VertexID
};

}  // namespace farcell
