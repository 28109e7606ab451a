// One renderer's picture from one camera: timed, then measured.
#pragma once

#include <functional>
#include <vector>

#include "cache/base/result.h"
#include "cache/pack/pack_file.h"
#include "runtime/renderer.h"
#include "tools/evaluate/report/entry.h"

namespace farcell {

struct Measurement {
  Entry entry;  // without the stem of its camera
  FrameImage image;
  std::vector<float> flip;  // flipErrors(), 1 a pixel
};

struct MeasureSettings {
  int timedFrames = 5;         // after one cold frame, whose page reads are counted
  uint64_t residentBytes = 0;  // see Renderer
  Colour background{};
};

// Draws a frame; the picture may be null.
using DrawFrame = std::function<Result<FrameStats>(FrameImage* image)>;
// 1 + timedFrames + 1 frames; the last is measured. `model`: what the distance of the eye is told by.
Result<Measurement> measureFrames(const Model& model, const Camera& camera, const RendererPlan& plan,
                                  const ReferenceImage& reference, const MeasureSettings& settings,
                                  const DrawFrame& draw);

// The same of a renderer of its own, so that nothing is resident at first.
Result<Measurement> measureRenderer(GlContext& context, const PackFile& pack, const Camera& camera,
                                    const RendererPlan& plan, const ReferenceImage& reference,
                                    const MeasureSettings& settings);

// The plan's meshPixels with which its frames take as long as targetMs, as nearly as kEqualTimeSteps measurements find
// it.
inline constexpr int kEqualTimeSteps = 7;
Result<double> meshPixelsOfTime(GlContext& context, const PackFile& pack, const Camera& camera,
                                const RendererPlan& plan, double targetMs, const MeasureSettings& settings);

}  // namespace farcell
