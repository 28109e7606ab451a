// The mean of the samples of several passes: each draws the picture into a multisampled target, moved by part of a
// pixel, so that a pixel gets more samples than the driver has.
//
// A move is the same for all samples of a pass. What leaves its pixel by it is counted in the neighbour that it comes
// to lie in: every pixel has the mean over its own square, however far the passes are moved, and the samples of all
// passes can be spread over it evenly. (At the rim of the picture, where there is no neighbour, the nearest is taken.)
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec2.hpp>
#include <vector>

#include "cache/base/result.h"
#include "runtime/draw/frame_target.h"
#include "runtime/gl/program.h"

namespace farcell {

inline constexpr int kMultisamples = 4;  // of a pass
inline constexpr int kMostPasses = 16;   // 64 samples

// Where the samples of a pass lie in it, from where those of pass 0 do, pixels, x right, y up, each in [-.5, .5). The
// first passes together, however many, have well spread samples (tests/bench/near).
glm::dvec2 sampleMove(int pass);

class SampleMean {
 public:
  // positions: of the samples of a pixel, [0, 1)^2, y up: as many as the targets have. withCoverage: as theirs.
  // REQUIRES: a current context.
  static Result<SampleMean> create(int width, int height, bool withCoverage, std::vector<glm::vec2> positions);

  bool matches(int width, int height, bool withCoverage) const {
    return width == width_ && height == height_ && withCoverage == withCoverage_;
  }
  void clear() { passes_ = 0; }
  int passes() const { return passes_; }
  // The next pass, 0 after `clear`: a picture moved by -sampleMove(passes()). REQUIRES: a target of several samples, of
  // this size; passes() < kMostPasses.
  void add(const FrameTarget& frame);

  // RGBA of 16 bits, premultiplied by coverage; row 0 is the bottom row. REQUIRES: passes() > 0; so of what follows.
  GLuint colour() const { return colour_.name(); }
  // Row 0 is the top row. Wait for the GPU.
  std::vector<uint8_t> readColour() const;
  std::vector<uint8_t> readCoverage() const;  // REQUIRES: withCoverage

 private:
  SampleMean(int width, int height, bool withCoverage, std::vector<glm::vec2> positions, GlProgram program);
  int width_;
  int height_;
  bool withCoverage_;
  int passes_ = 0;
  std::vector<glm::vec2> positions_;
  GlProgram program_;
  GlTexture colour_;
  GlTexture coverage_;
  GlFramebuffer framebuffer_;
  GlVertexArray bare_;  // corners come from gl_VertexID
};

}  // namespace farcell
