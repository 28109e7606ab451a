// Bakes orthographic views of a cell: the prefiltered appearance from a direction and from its antipode at once.
//
// The life of a view: begin -> add (any number of chunks of triangles; a z-buffer does not care about order) ->
// finish. Each texel is the mean of samples on a regular sub-grid; triangles are rasterised by SIMD code chosen at run
// time (Highway), which gives the same bits on every instruction set.
//
// Inside: rasterise.h finds the nearest and the farthest triangle of every sample (sample_image.h), settle.h gives
// those samples their colour, resolve.h makes texels of them.
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <memory>
#include <vector>

#include "cache/schema/view_frame.h"
#include "preprocess/mesh/texture_sampler.h"
#include "preprocess/mesh/texture_source.h"

namespace farcell {

// Triangles of one grown cell in cell-local coordinates (view_frame.h), clipped to [-kCellGrowth, kCellGrowth]^3.
// Structure of arrays, so that one SIMD lane is one triangle.
struct CellSoup {
  // corner k of triangle t is at (x[k][t], y[k][t], z[k][t])
  std::array<std::vector<float>, 3> x, y, z;
  std::array<std::vector<uint32_t>, 3> colours;  // albedo, 0x00BBGGRR
  // Unit normals, octahedral as in GeometryPage; empty: flat, the face's own normal.
  std::array<std::vector<uint32_t>, 3> normals;
  // What multiplies the albedo: kNoTexture, or the name of a texture and the corners' coordinates on it. Empty: no
  // triangle has one.
  std::vector<uint32_t> textures;
  std::array<std::vector<float>, 3> u, v;

  size_t size() const { return x[0].size(); }
  void clear();
};

struct BakeSettings {
  int imageSize = 128;       // texels along an edge
  int samples = 16;          // per texel: 1, 4, 16, 64 (a square number: 1x1, 2x2, 4x4, 8x8)
  glm::vec3 sun{0, 0, 1};    // unit, world axes (shading.h)
  bool relightable = false;  // no sun: bakes albedo, and the mean normal
};

// A finished view, cropped to its covered texels, before quantisation.
struct BakedView {
  int x0 = 0, y0 = 0, width = 0, height = 0;  // texels; width == 0: nothing was hit
  std::vector<float> rgba;    // 4 per texel, [0, 1], premultiplied: mean over all samples; alpha is coverage
  std::vector<float> depth;   // 1 per texel: mean w of the covered samples within kDepthAverageTexels of the nearest
                              // one; -infinity where nothing was hit
  std::vector<float> normal;  // 3 per texel: mean of the covered samples' unit normals on the viewer's side; 0 where
                              // nothing was hit; empty unless relightable
};
// Averaging depth across a silhouette would put the surface in mid-air.
inline constexpr float kDepthAverageTexels = 3;

// Scratch for one pair of views; reused from pair to pair. Not thread-safe: one per thread.
class ViewBaker {
 public:
  // textures: needed by chunks that have some; must outlive the baker.
  explicit ViewBaker(const BakeSettings& settings, TextureSampler* textures = nullptr);
  ~ViewBaker();
  ViewBaker(ViewBaker&&) noexcept;

  // What was added since the last begin and not finished is forgotten.
  void begin(const ViewFrame& frame);
  // The chunk is not needed any more when this returns. How triangles are split into chunks changes no bit of the
  // result: of equal depths the triangle that was added first counts. Fewer than 2^30 triangles a chunk.
  void add(const CellSoup& chunk);
  // The view from frame.toward, and the one from -frame.toward in viewFrame(-frame.toward)'s image coordinates: bit for
  // bit the view that would be baked from there. REQUIRES: begin since the last finish.
  void finish(BakedView& view, BakedView& antipode);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace farcell
