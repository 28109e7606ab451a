// Which cells of a frame are hidden by its near leaves, before any page of theirs is read: what stands in the streets
// of a city hides most of it.
//
// Conservative: a cell is called hidden only where every sample of the picture that its content box, 2 pixels around
// it and what an impostor's filter adds can reach is covered by a nearer triangle of a leaf that is drawn in full. The
// samples are those of the picture, so that a gap between two triangles that the picture shows is a gap here.
// Rasterisers round vertices to 1/256 of a pixel: the 2 pixels stand for that in what is hidden, kSnapPixels in what
// hides.
#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <map>
#include <span>
#include <vector>

#include "cache/base/result.h"
#include "cache/pack/pack_file.h"
#include "runtime/camera/camera.h"
#include "runtime/occlusion/coverage_tiles.h"
#include "runtime/occlusion/occluders.h"
#include "runtime/selection/hidden_cells.h"
#include "runtime/selection/selection.h"

namespace farcell {

// Occluders of leaves that were near, kept from frame to frame.
class OccluderCache {
 public:
  explicit OccluderCache(const PackFile& pack) : pack_(pack) {}
  // Valid until the next call. bytesRead: grows by what had to be read.
  Result<std::span<const Occluder>> of(uint32_t leaf, uint64_t& bytesRead);

 private:
  struct Kept {
    std::vector<Occluder> occluders;
    uint64_t lastUse = 0;
  };
  const PackFile& pack_;
  std::map<uint32_t, Kept> kept_;
  uint64_t clock_ = 0;
};

struct OcclusionView {
  int width = 0;
  int height = 0;
  std::span<const glm::vec2> samples;  // 1 or 4 of a pixel, y up
  glm::dvec2 jitterPx{0};
};

// Where nothing was hidden that was worth the search, some frames go without one: one, then twice as many each time up
// to 16. Pictures are the same, but where a budget binds and a still camera's next search finds what pays.
class OcclusionRest {
 public:
  bool resting() { return left_ > 0 && left_-- > 0; }
  void tried(bool pays) {
    last_ = pays ? 0 : last_ == 0 ? 1 : 2 * last_ < kMost ? 2 * last_ : kMost;
    left_ = last_;
  }

 private:
  static constexpr int kMost = 16;
  int last_ = 0;
  int left_ = 0;
};

class Occlusion : public HiddenCells {
 public:
  // The leaves that the cut draws in full, nearest first, as far as they are not hidden themselves and their triangles
  // are large on screen. Fails as reading a page does.
  static Result<Occlusion> of(const Directory& directory, const Camera& camera, const OcclusionView& view,
                              const Cut& cut, OccluderCache& cache, uint64_t& bytesRead);

  bool hides(uint32_t cell) const override;
  bool needs(uint32_t cell) const override;
  uint64_t triangles() const { return triangles_; }  // that hide
  uint64_t tilesTouched() const { return tiles_.tilesTouched(); }
  // That finding what is hidden takes, with so many cells to ask about.
  double expectedMs(size_t cells) const;

 private:
  Occlusion(const Directory& directory, const Camera& camera, const OcclusionView& view);
  void add(uint32_t leaf, std::span<const Occluder> occluders);
  void add(const Occluder& occluder);
  // Whether the triangles a, b, own and a, b, across (camera space) lie on different sides of their edge on screen.
  bool inner(glm::dvec3 a, glm::dvec3 b, glm::dvec3 own, glm::dvec3 across) const;
  glm::dvec3 cameraSpace(glm::dvec3 steps) const;  // x right, y up, z ahead, steps
  glm::dvec3 screen(glm::dvec3 camera) const;      // pixels, y up; z: 1 / ahead

  const Directory& directory_;
  glm::dvec3 eye_{0};  // steps
  CameraAxes axes_;
  double focalPx_ = 1;
  glm::dvec2 centrePx_{0};
  double near_ = 1;  // steps
  CoverageTiles tiles_;
  std::vector<uint32_t> leaves_;  // sorted
  uint64_t triangles_ = 0;
};

}  // namespace farcell
