// Turns a pack and a camera into pixels: select -> make resident -> draw triangles -> composite impostors -> resolve.
#pragma once

#include <cstdint>
#include <memory>

#include "cache/base/result.h"
#include "cache/pack/pack_file.h"
#include "runtime/camera/light.h"
#include "runtime/cost/draw_costs.h"
#include "runtime/draw/backdrop.h"
#include "runtime/draw/impostor_kind.h"
#include "runtime/draw/show.h"
#include "runtime/frame_image.h"
#include "runtime/gl/context.h"
#include "runtime/selection/selection.h"

namespace farcell {

// Of RenderSettings::samplesPerPixel: 8 where triangles may cover more than a fifth of what is drawn, and a time budget
// has room for them; else 4: impostors are prefiltered, more samples add little to them.
inline constexpr int kSamplesAsNeeded = 0;

struct RenderSettings {
  int width = 1280;
  int height = 720;
  // 1, 4 (multisampling), or 8, 16, 64 (so many passes of 4, sample_mean.h), or kSamplesAsNeeded.
  int samplesPerPixel = 4;
  ImpostorKind kind = ImpostorKind::depthCorrected;
  SelectionSettings selection;  // its costs are those of `kind` and samples here
  CostModel costs = kDefaultCosts;
  bool occlusion = false;        // cells that nearer triangles hide are not drawn; mode `full` draws them all the same
  bool occlusionMustPay = true;  // only where that is expected to save more time than the search takes
  Show show = Show::picture;
  Light light;  // of a pack of baked light: its own sun
  bool handOver =
      true;  // of pictures of 4 samples or more: cells change how they are drawn without a pop (hand_over.h)
  bool operator==(const RenderSettings&) const = default;
};

struct FrameStats {
  double wallMs = 0;  // selection, draw and finish (`draw`) or hand-over to the GPU (`show`); without reading pages
                      // when all were resident
  double cpuMs = 0;   // of the whole process
  uint64_t triangles = 0;   // drawn, of leaves and of meshes
  uint64_t meshes = 0;      // inner cells drawn as their simplified meshes
  uint64_t impostors = 0;   // cells drawn as impostors
  uint64_t texels = 0;      // of the views drawn (cropped rectangles)
  uint64_t bytesRead = 0;   // from the pack for this frame
  int samples = 0;          // per pixel, drawn in this frame
  FrameWork work;           // as selection foresaw it, in each of the frame's passes
  double expectedMs = 0;    // that it takes, by RenderSettings::costs
  double expectedLoss = 0;  // Cut::loss and Cut::lossBound
  double lossBound = 0;
  // What nearer triangles hide and was neither drawn nor read (Cut::hidden), the time it was expected to take, and the
  // time finding it took. 0 where it was not looked for.
  uint64_t hiddenCells = 0;
  uint64_t hiddenTriangles = 0;
  uint64_t hiddenBytes = 0;
  double hiddenMs = 0;
  double occlusionMs = 0;
  uint64_t occlusionBytes = 0;      // of bytesRead, what was read to find it
  std::vector<LegendEntry> legend;  // of RenderSettings::show; empty for the picture
  bool settled = true;              // of `show`: the same once more would show the same picture
};

// Draws one pack. All calls on the thread of the context.
class Renderer {
 public:
  // residentBytes: how much of the pack may stay on the GPU between frames, one half for triangles, one for views; a
  // frame that needs more draws its cells in portions. The least is one cell of each, whatever its size.
  // `context` and `pack` must outlive the renderer.
  static Result<Renderer> create(GlContext& context, const PackFile& pack, uint64_t residentBytes);
  Renderer(Renderer&&) noexcept;
  ~Renderer();

  // Draws and waits until the GPU is done. `image` may be null: then nothing is read back (timing).
  // invalidArgument: a size, number of samples or light that cannot be; else what reading pages failed with.
  Result<FrameStats> draw(const Camera& camera, const RenderSettings& settings, FrameImage* image);

  // Draws over the backdrop into a framebuffer (of this OpenGL name; 0: the window's), whose size is that of
  // `settings`, and does not wait for the GPU. Where more than 1 sample is asked for, frames of a camera that rests
  // gather 64, a pass a frame, until the picture has `settled`; then nothing is drawn any more. Fails as `draw` does.
  Result<FrameStats> show(const Camera& camera, const RenderSettings& settings, const Backdrop& backdrop,
                          uint32_t framebuffer = 0);
  // The picture that `show` would show, alpha 255, read back.
  Result<FrameImage> capture(const Camera& camera, const RenderSettings& settings, const Backdrop& backdrop);

 private:
  struct Impl;
  explicit Renderer(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace farcell
