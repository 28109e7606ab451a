// One renderer's picture from one camera: timed, then measured.
#pragma once

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

// A renderer of its own, so that nothing is resident at first, draws 1 + timedFrames + 1 frames; the last is measured.
Result<Measurement> measureRenderer(GlContext& context, const PackFile& pack, const Camera& camera,
                                    const RendererPlan& plan, const ReferenceImage& reference,
                                    const MeasureSettings& settings);

}  // namespace farcell
