// Lines over a finished frame, a pixel wide, before nothing and behind nothing: impostors leave no depth to hide them.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "cache/base/result.h"
#include "cache/pack/directory.h"
#include "runtime/draw/frame_camera.h"
#include "runtime/gl/program.h"

namespace farcell {

struct LineEnd {
  glm::vec3 position{0};  // relative to the eye, grid steps
  std::array<uint8_t, 4> colour{};
};

// Each appends pairs of ends.
void addBox(std::vector<LineEnd>& lines, const GridBox& box, glm::dvec3 eyeSteps, std::array<uint8_t, 3> colour);
// The rectangle that a flat impostor is drawn on (impostor_flat.vert); nothing for an empty view.
void addBillboard(std::vector<LineEnd>& lines, const shared::ImpostorInstance& instance, std::array<uint8_t, 3> colour);

class LinePainter {
 public:
  // REQUIRES: a current context.
  static Result<LinePainter> create();
  // Into the bound target. REQUIRES: the frame's uniforms bound at 0.
  void paint(std::span<const LineEnd> lines);

 private:
  explicit LinePainter(GlProgram program);
  GlProgram program_;
  GlBuffer ends_;
  GlVertexArray layout_;
};

}  // namespace farcell
