// What pictures are compared with: the paper's perspective rendering of the triangles at one sample a pixel, and 64
// rays a pixel.
#pragma once

#include "tests/bench/wscg2010/draw/painter.h"
#include "tools/evaluate/metrics/metrics.h"
#include "tools/evaluate/reference/traced_geometry.h"

namespace farcell::wscg {

// All triangles of a scene, ready to draw and to trace. Must not outlive the context.
class FullGeometry {
 public:
  static Result<FullGeometry> create(const Scene& scene);

  const VertexBuffer& triangles() const { return triangles_; }
  FrameImage draw(Painter& painter, const Camera& camera) const;
  // samples: a square number up to 64.
  ReferenceImage trace(const Camera& camera, int width, int height, int samples) const;

 private:
  FullGeometry(VertexBuffer triangles, EmbreeDevice device, TracedGeometry traced, glm::vec3 sun);

  VertexBuffer triangles_;
  EmbreeDevice device_;  // outlives the scene in traced_
  TracedGeometry traced_;
  glm::vec3 sun_;
};

// A frame as a reference.
ReferenceImage referenceOf(const FrameImage& image);

// Everything is compared on black: gaps between cells show as the paper's black lines.
inline constexpr Colour kBackground = {0, 0, 0};

// metrics.h, over the part of the picture where either of the two has anything: the rest is equal. No ssim.
Metrics measureFrame(const ReferenceImage& reference, const FrameImage& frame);

}  // namespace farcell::wscg
