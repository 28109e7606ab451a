// Turns a pack and a camera into pixels: select -> make resident -> draw triangles -> composite impostors -> resolve.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "cache/base/result.h"
#include "cache/pack/pack_file.h"
#include "runtime/camera/camera.h"
#include "runtime/gl/context.h"
#include "runtime/selection/selection.h"

namespace farcell {

enum class ImpostorKind {
  flat,            // the billboard of the 2010 paper: one view on a plane through the cell's centre
  depthCorrected,  // kind A: one view, the ray corrected by its depth
};

struct RenderSettings {
  int width = 1280;
  int height = 720;
  int samplesPerPixel = 4;   // of triangles: 1, 4 (multisampling) or 16 (four jittered passes of 4)
  ImpostorKind kind = ImpostorKind::depthCorrected;
  SelectionSettings selection;
};

struct FrameStats {
  double wallMs = 0;          // selection, draw and finish; without reading pages when all were resident
  double cpuMs = 0;           // of the whole process
  uint64_t triangles = 0;     // drawn
  uint64_t impostors = 0;     // cells drawn as impostors
  uint64_t texels = 0;        // of the views drawn (cropped rectangles)
  uint64_t bytesRead = 0;     // from the pack for this frame
};

// Row 0 is the top row. RGBA8 premultiplied by coverage, without background: alpha is coverage.
struct FrameImage {
  int width = 0;
  int height = 0;
  std::vector<uint8_t> rgba;
  // Share of each pixel's coverage drawn by impostors, 0..255 (1 byte a pixel).
  std::vector<uint8_t> impostorCoverage;
};

// Draws one pack. All calls on the thread of the context.
class Renderer {
 public:
  // residentBytes: how much of the pack may stay on the GPU between frames; a frame that needs more draws its cells
  // in portions.
  static Result<Renderer> create(GlContext& context, const PackFile& pack, uint64_t residentBytes);
  Renderer(Renderer&&) noexcept;
  ~Renderer();

  // Draws and waits until the GPU is done. `image` may be null: then nothing is read back (timing).
  Result<FrameStats> draw(const Camera& camera, const RenderSettings& settings, FrameImage* image);

 private:
  struct Impl;
  explicit Renderer(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace farcell
