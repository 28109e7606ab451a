// A picture in the making: of every pixel, which samples have found their surface, and the sum of their colours.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "tools/evaluate/metrics/images.h"
#include "tools/evaluate/reference/traced_geometry.h"
#include "tools/evaluate/reference/view.h"

namespace farcell {

class SampleImage {
 public:
  // perAxis^2 samples a pixel, 1 to 8; `light` as in shading.h.
  SampleImage(const ReferenceView& view, int perAxis, glm::vec3 light);

  // Whether any sample of the rectangle is still without a surface.
  bool unresolved(const ScreenBounds& bounds) const;

  // Traces the open samples through each geometry in turn; a sample that hits one is closed. Transparent surfaces
  // along a ray are blended in their order: exact, however few the samples. Geometries come front to back, and none may lie both before and behind another along any ray. Same result for any number of threads.
  void trace(std::span<const TracedGeometry> geometries, int threads);

  ReferenceImage finish() const;

 private:
  struct Pixel {
    uint64_t open = 0;  // bit s: sample s has hit nothing yet
    glm::vec3 sum{0};   // of lit colours, [0, 1] each
    float through = 0;  // sum over closed samples of what passed all their surfaces
  };
  class Packet;
  void traceRows(const TracedGeometry& geometry, const ScreenBounds& bounds, int rowBegin, int rowEnd);

  ReferenceView view_;
  int perAxis_;
  glm::vec3 light_;
  std::vector<Pixel> pixels_;
};

}  // namespace farcell
