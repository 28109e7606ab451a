// A camera path's frames, drawn by every renderer beside their references: error, change, switches and time of each.
#pragma once

#include <filesystem>
#include <functional>
#include <vector>

#include "runtime/renderer.h"
#include "tools/evaluate/metrics/images.h"
#include "tools/evaluate/packs.h"
#include "tools/evaluate/report/path_entry.h"

namespace farcell {

struct PathSettings {
  std::filesystem::path output;  // directory of the pictures
  uint64_t residentBytes = 0;    // of each renderer
  Colour background{};
  std::vector<RendererPlan> plans;
  std::function<Result<ReferenceImage>(const Camera& camera)> trace;
  std::function<void()> pictureDone;
};

// Goes through the frames once; of pictures, those of two frames are in memory. Each renderer keeps its pages from
// frame to frame. Of each renderer's frame of the worst flicker the pictures are written (pictures.h). `entry`, with
// name and stem, gets the frames that all renderers have drawn, also when a later one fails.
Result<> measurePath(GlContext& context, const Packs& packs, const std::vector<Camera>& frames,
                     const PathSettings& settings, PathEntry& entry);

}  // namespace farcell
