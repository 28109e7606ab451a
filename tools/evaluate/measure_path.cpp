#include "tools/evaluate/measure_path.h"

#include <utility>

#include "cache/base/interrupt.h"
#include "tools/evaluate/metrics/metrics.h"
#include "tools/evaluate/path/switches.h"
#include "tools/evaluate/report/pictures.h"

namespace farcell {
namespace {

// One renderer on its way, with what it needs of the frame before.
struct Walker {
  RendererPlan plan;
  const PackFile& pack;
  Renderer renderer;
  Cut cut;
  std::vector<float> picture;  // composited; empty before the first frame
  double worstFlicker = -1;
};

// The reference of a frame, and the same composited with the one before it.
struct Truth {
  ReferenceImage image;
  std::vector<float> before, now;
};

struct Walk {
  const PathSettings& settings;
  const std::string& stem;
  std::vector<Walker> walkers;
  Truth truth;
};

Result<std::vector<Walker>> makeWalkers(GlContext& context, const Packs& packs, const PathSettings& settings) {
  std::vector<Walker> walkers;
  for (const RendererPlan& plan : settings.plans) {
    const PackFile& pack = packs.of(plan);
    FARCELL_ASSIGN(Renderer renderer, Renderer::create(context, pack, settings.residentBytes));
    walkers.push_back({plan, pack, std::move(renderer), {}, {}});
  }
  return walkers;
}

// Timed on its own: a frame that is read back costs more.
Result<std::vector<float>> drawFrame(Walker& walker, const Camera& camera, const Colour& background, PathFrame& frame) {
  FARCELL_ASSIGN(const FrameStats stats, walker.renderer.draw(camera, walker.plan.settings, nullptr));
  frame.wallMs = stats.wallMs;
  frame.cpuMs = stats.cpuMs;
  frame.bytesRead = stats.bytesRead;
  frame.triangles = stats.triangles;
  frame.impostors = stats.impostors;
  FrameImage image;
  FARCELL_TRY(walker.renderer.draw(camera, walker.plan.settings, &image));
  return composite(TestImage{image.width, image.height, image.rgba, image.impostorCoverage}, background);
}

Result<> compareWithBefore(const Walk& walk, Walker& walker, std::span<const float> picture, PathFrame& frame) {
  const Truth& truth = walk.truth;
  std::vector<float> map;
  frame.change = measureChange({walker.picture, truth.before}, {picture, truth.now}, &map);
  if (frame.change.flicker <= walker.worstFlicker) return {};
  walker.worstFlicker = frame.change.flicker;
  return writeWorstFrame(walk.settings.output, {walk.stem + "." + walker.plan.name, truth.image.width,
                                                truth.image.height, walker.picture, picture, truth.now, map});
}

Result<PathFrame> step(Walk& walk, Walker& walker, const Camera& camera) {
  FARCELL_TRY(checkInterrupt());
  const RenderSettings& settings = walker.plan.settings;
  PathFrame frame;
  FARCELL_ASSIGN(std::vector<float> picture, drawFrame(walker, camera, walk.settings.background, frame));
  frame.paperError = paperError(walk.truth.image, walk.truth.now, picture);
  Cut cut = selectCut(walker.pack.directory(), camera, settings.width, settings.height, settings.selection);
  if (!walker.picture.empty()) {
    FARCELL_TRY(compareWithBefore(walk, walker, picture, frame));
    const Switches switches = countSwitches(walker.pack.directory(), walker.cut, cut, settings.kind);
    frame.viewSwitches = switches.views;
    frame.levelSwitches = switches.levels;
  }
  walker.cut = std::move(cut);
  walker.picture = std::move(picture);
  walk.settings.pictureDone();
  return frame;
}

}  // namespace

Result<> measurePath(GlContext& context, const Packs& packs, const std::vector<Camera>& frames,
                     const PathSettings& settings, PathEntry& entry) {
  FARCELL_ASSIGN(std::vector<Walker> walkers, makeWalkers(context, packs, settings));
  Walk walk{settings, entry.stem, std::move(walkers), {}};
  for (const Walker& walker : walk.walkers) entry.runs.push_back({walker.plan, {}});
  for (const Camera& camera : frames) {
    FARCELL_ASSIGN(walk.truth.image, settings.trace(camera));
    walk.truth.before = std::exchange(walk.truth.now, composite(walk.truth.image, settings.background));
    settings.pictureDone();
    std::vector<PathFrame> drawn;
    for (Walker& walker : walk.walkers) {
      FARCELL_ASSIGN(const PathFrame frame, step(walk, walker, camera));
      drawn.push_back(frame);
    }
    for (size_t i = 0; i < drawn.size(); ++i) entry.runs[i].frames.push_back(drawn[i]);
  }
  return {};
}

}  // namespace farcell
