// Where a frame is drawn: RGBA8 premultiplied by coverage, 32-bit float reversed depth, one or four samples a pixel.
#pragma once

#include <cstdint>
#include <vector>

#include "runtime/gl/objects.h"

namespace farcell {

class FrameTarget {
 public:
  // samples: 1 or 4. withCoverage: a second attachment takes the impostors' share. REQUIRES: a current context.
  FrameTarget(int width, int height, int samples, bool withCoverage);

  bool matches(int width, int height, int samples, bool withCoverage) const {
    return width == width_ && height == height_ && samples == samples_ && withCoverage == withCoverage_;
  }
  int width() const { return width_; }
  int height() const { return height_; }
  // Binds and clears: transparent, infinitely far away.
  void begin() const;
  // Means of the samples of each pixel.
  void resolve() const;
  // The texture of the means, after resolve; row 0 is the bottom row.
  GLuint colour() const { return result().colour.name(); }
  // Multisampled where there are several samples.
  GLuint drawnColour() const { return drawn_.colour.name(); }
  GLuint drawnCoverage() const { return drawn_.coverage.name(); }   // REQUIRES: withCoverage
  GLuint framebuffer() const { return drawn_.framebuffer.name(); }  // what `begin` binds
  // After resolve; row 0 is the top row. Waits for the GPU.
  std::vector<uint8_t> readColour() const;
  std::vector<uint8_t> readCoverage() const;  // REQUIRES: withCoverage

 private:
  struct Attachments {
    GlTexture colour;
    GlTexture coverage;
    GlTexture depth;
    GlFramebuffer framebuffer;
  };
  Attachments makeAttachments(int samples, bool withDepth) const;
  const Attachments& result() const { return samples_ > 1 ? resolved_ : drawn_; }

  int width_;
  int height_;
  int samples_;
  bool withCoverage_;
  Attachments drawn_;
  Attachments resolved_;  // only with several samples
};

}  // namespace farcell
