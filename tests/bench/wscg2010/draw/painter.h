// The experiment's own small renderer: lit triangles, flat billboards one texture each, lines. One sample a pixel,
// reversed depth without a far plane.
#pragma once

#include <cstdint>
#include <glm/mat4x4.hpp>
#include <span>
#include <string_view>
#include <vector>

#include "runtime/camera/camera.h"
#include "runtime/draw/frame_target.h"
#include "runtime/frame_image.h"
#include "runtime/gl/program.h"
#include "tests/bench/wscg2010/scene/impostors.h"

namespace farcell::wscg {

enum class Filter { nearest, linear };

// How the rim of an image is drawn.
enum class Rim {
  alphaTest,  // texels of half coverage or more, opaque
  blended,    // over what is behind: billboards must come farthest first
};

struct DrawSettings {
  Filter filter = Filter::linear;
  Rim rim = Rim::alphaTest;
};

struct ColouredVertex {
  glm::vec3 position{0};
  uint32_t colour = 0;  // 0x00BBGGRR
};

struct VertexBuffer {
  GlBuffer buffer;
  GLsizei count = 0;  // vertices
};

// All need a current context.
VertexBuffer uploadTriangles(std::span<const Triangle> triangles, glm::vec3 sun);
GlTexture uploadImage(int width, int height, std::span<const uint8_t> rgba, Filter filter);

// Clip coordinates of a camera; z is constant: depth z / w falls with distance.
glm::mat4 clipFromWorld(const Camera& camera, int width, int height);

class Painter {
 public:
  static Result<Painter> create(int width, int height);

  int width() const { return width_; }
  int height() const { return height_; }
  // A frame: begin, what is to be seen (triangles before billboards), then read or finish.
  void begin(const Camera& camera);
  void drawTriangles(const VertexBuffer& triangles);
  void drawLines(std::span<const ColouredVertex> ends);  // two each; over everything drawn so far
  void beginBillboards(const DrawSettings& settings);
  void drawBillboard(const Billboard& billboard, const GlTexture& texture);
  // All three steps for each: uploads the image, draws it, drops it.
  void drawBillboards(std::span<const Billboard> billboards, const DrawSettings& settings);
  FrameImage read() const;
  void finish() const;  // waits until all is drawn

 private:
  struct Programs {
    GlProgram solid, billboard;
  };
  struct Places {
    GLint solidClip = -1, clip = -1, origin = -1, alongX = -1, alongY = -1, blended = -1;
  };
  Painter(int width, int height, Programs programs);
  void bindVertices(GLuint buffer) const;

  int width_, height_;
  Programs programs_;
  Places places_;
  FrameTarget target_;
  GlVertexArray vertices_;  // position, colour
  GlVertexArray bare_;
  glm::mat4 clip_{1};
};

}  // namespace farcell::wscg
