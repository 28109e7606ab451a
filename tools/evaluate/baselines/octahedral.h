// Octahedral impostors as game engines have them, for comparison: 16 x 16 views of the whole model over the upper
// hemisphere, the three nearest blended, each with one step of parallax by its depth.
//
// One impostor of the whole model, not one a cell: of equal memory that is the fairest to it, for 256 views of each
// cell would leave a cell a few texels. It does not go into the pack; its views are baked when it is asked for.
#pragma once

#include <array>
#include <vector>

#include "cache/pack/pack_file.h"
#include "runtime/draw/frame_target.h"
#include "runtime/renderer.h"
#include "tools/evaluate/baselines/octahedral_bake.h"

namespace farcell {

class OctahedralImpostor {
 public:
  // Uploads. `context` must be current and outlive it.
  static Result<OctahedralImpostor> create(GlContext& context, const OctahedralViews& views);

  // Draws and waits until the GPU is done; `image` may be null. Of the statistics, bytesRead is 0.
  FrameStats draw(const Camera& camera, int width, int height, FrameImage* image) const;

 private:
  OctahedralImpostor(GlProgram program, const OctahedralViews& views);
  void setUniforms(const Camera& camera, int width, int height) const;

  GlProgram program_;
  GlTexture colours_, depths_;
  GlVertexArray nothing_;
  int edge_ = 0;
  glm::dvec3 centre_{0};
  double unit_ = 1, halfExtent_ = 1;
  std::array<glm::dvec3, 3> grid_{};
  std::vector<ViewFrame> axes_;
};

// What a frame of the pack's own renderer needs in memory, decoded, to draw the cut: the pages of its cells.
uint64_t residentBytes(const Directory& directory, const Cut& cut, ImpostorKind kind);

}  // namespace farcell
