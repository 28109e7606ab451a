#include "runtime/calibration/calibration.h"

#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <optional>
#include <vector>

#include "runtime/calibration/ball_pack.h"
#include "runtime/cost/cost_fit.h"
#include "runtime/cost/cost_store.h"
#include "runtime/renderer.h"

namespace farcell {
namespace {

constexpr int kWidth = 320, kHeight = 180;
constexpr int kFrames = 2;               // of which the faster counts: what else runs only adds
constexpr double kDistances[] = {2, 5};  // from the middle, radii
constexpr uint64_t kResidentBytes = uint64_t{64} << 20;

Camera cameraAt(double distance, bool away) {
  const glm::dvec3 position(distance * 0.8, distance * 0.36, distance * 0.48);
  return {"calibration", position, away ? position * 2.0 : glm::dvec3(0), glm::dvec3(0, 0, 1), 0.8};
}

RenderSettings settingsOf(RenderMode mode, ImpostorKind kind, int samples) {
  RenderSettings settings;
  settings.width = kWidth;
  settings.height = kHeight;
  settings.samplesPerPixel = samples;
  settings.kind = kind;
  settings.selection.mode = mode;
  settings.occlusion = false;
  return settings;
}

Result<TimedFrame> timed(Renderer& renderer, const Camera& camera, const RenderSettings& settings) {
  FARCELL_ASSIGN(FrameStats best, renderer.draw(camera, settings, nullptr));  // reads the pages, compiles
  best.wallMs = 1e9;
  for (int frame = 0; frame < kFrames; ++frame) {
    FARCELL_ASSIGN(const FrameStats stats, renderer.draw(camera, settings, nullptr));
    if (stats.wallMs < best.wallMs) best = stats;
  }
  return TimedFrame{best.work, std::max(best.wallMs, 1e-6)};
}

// Where no triangle is drawn a picture has one sample a pixel: the frames of impostors have some too.
Result<std::vector<TimedFrame>> timedFrames(Renderer& renderer, RenderMode mode, ImpostorKind kind, int samples) {
  std::vector<TimedFrame> frames;
  for (const double distance : kDistances) {
    FARCELL_ASSIGN(const TimedFrame frame, timed(renderer, cameraAt(distance, false), settingsOf(mode, kind, samples)));
    frames.push_back(frame);
  }
  return frames;
}

Result<CostModel> measureWith(Renderer& renderer) {
  CostModel costs;
  for (const int samples : {1, 4}) {
    FARCELL_ASSIGN(const std::vector<TimedFrame> geometry,
                   timedFrames(renderer, RenderMode::triangles, ImpostorKind::flat, samples));
    FARCELL_ASSIGN(const TimedFrame empty,
                   timed(renderer, cameraAt(2, true), settingsOf(RenderMode::triangles, ImpostorKind::flat, samples)));
    for (const ImpostorKind kind : {ImpostorKind::flat, ImpostorKind::depthCorrected, ImpostorKind::blended}) {
      FARCELL_ASSIGN(std::vector<TimedFrame> frames, timedFrames(renderer, RenderMode::impostors, kind, samples));
      frames.insert(frames.end(), geometry.begin(), geometry.end());
      frames.push_back(empty);
      costs.draws[2 * static_cast<size_t>(kind) + (samples > 1)] = fitCosts(frames);
    }
  }
  return costs;
}

}  // namespace

Result<CostModel> measureCosts(GlContext& context) {
  std::error_code error;
  const std::filesystem::path path =
      std::filesystem::temp_directory_path(error) / fmt::format("farcell-costs-{}.far", static_cast<int>(::getpid()));
  FARCELL_TRY(writeBallPack(path));
  Result<PackFile> pack = PackFile::open(path);
  std::filesystem::remove(path, error);
  if (!pack) return tl::unexpected<Error>(std::move(pack).error());
  FARCELL_ASSIGN(Renderer renderer, Renderer::create(context, *pack, kResidentBytes));
  return measureWith(renderer);
}

Result<CostModel> machineCosts(GlContext& context, bool again) {
  const auto path = costsPath(context.renderer());
  if (path && !again) {
    if (const auto kept = loadCosts(*path, context.renderer())) return *kept;
  }
  FARCELL_ASSIGN(const CostModel costs, measureCosts(context));
  if (path) (void)saveCosts(*path, costs, context.renderer());  // where it cannot be kept, it is measured again
  return costs;
}

}  // namespace farcell
