#include "tools/evaluate/measure_renderer.h"

#include <glm/geometric.hpp>

#include "cache/base/interrupt.h"
#include "tools/evaluate/plan/equal_time.h"
#include "tools/evaluate/plan/sweep.h"

namespace farcell {
namespace {

double eyeDiameters(const Model& model, const Camera& camera) {
  const glm::dvec3 min = model.grid.worldFromGrid(model.bounds.min), max = model.grid.worldFromGrid(model.bounds.max);
  const double diameter = glm::length(max - min);
  return diameter > 0 ? (glm::length(camera.position - (min + max) * 0.5) - diameter / 2) / diameter : 0;
}

Result<> timeFrames(const DrawFrame& draw, int frames, Entry& entry) {
  std::vector<double> wallMs, cpuMs;
  for (int frame = 0; frame < frames; ++frame) {
    FARCELL_TRY(checkInterrupt());
    FARCELL_ASSIGN(const FrameStats stats, draw(nullptr));
    wallMs.push_back(stats.wallMs);
    cpuMs.push_back(stats.cpuMs);
  }
  entry.frame = frameTimes(wallMs);
  entry.cpuMs = medianOf(cpuMs);
  return {};
}

}  // namespace

Result<Measurement> measureFrames(const Model& model, const Camera& camera, const RendererPlan& plan,
                                  const ReferenceImage& reference, const MeasureSettings& settings,
                                  const DrawFrame& draw) {
  Measurement result;
  Entry& entry = result.entry;
  entry.camera = camera.name;
  entry.renderer = plan;
  entry.diameters = eyeDiameters(model, camera);
  FARCELL_ASSIGN(const FrameStats cold, draw(nullptr));
  entry.bytesRead = cold.bytesRead;
  FARCELL_TRY(timeFrames(draw, settings.timedFrames, entry));
  FARCELL_ASSIGN(const FrameStats last, draw(&result.image));
  entry.triangles = last.triangles;
  entry.meshes = last.meshes;
  entry.impostors = last.impostors;
  entry.texels = last.texels;
  const TestImage test{result.image.width, result.image.height, result.image.rgba, result.image.impostorCoverage};
  entry.metrics = measure(reference, test, settings.background, &result.flip);
  return result;
}

Result<Measurement> measureRenderer(GlContext& context, const PackFile& pack, const Camera& camera,
                                    const RendererPlan& plan, const ReferenceImage& reference,
                                    const MeasureSettings& settings) {
  FARCELL_ASSIGN(Renderer renderer, Renderer::create(context, pack, settings.residentBytes));
  return measureFrames(pack.directory().model, camera, plan, reference, settings,
                       [&](FrameImage* image) { return renderer.draw(camera, plan.settings, image); });
}

Result<double> meshPixelsOfTime(GlContext& context, const PackFile& pack, const Camera& camera,
                                const RendererPlan& plan, double targetMs, const MeasureSettings& settings) {
  FARCELL_ASSIGN(Renderer renderer, Renderer::create(context, pack, settings.residentBytes));
  return settingOfTime(kLeastMeshPixels, kMostMeshPixels, kEqualTimeSteps, targetMs,
                       [&](double meshPixels) -> Result<double> {
                         RenderSettings tried = plan.settings;
                         tried.selection.meshPixels = meshPixels;
                         Entry entry;
                         const DrawFrame draw = [&](FrameImage* image) { return renderer.draw(camera, tried, image); };
                         FARCELL_TRY(draw(nullptr));  // reads its pages
                         FARCELL_TRY(timeFrames(draw, settings.timedFrames, entry));
                         return entry.frame.medianMs;
                       });
}

}  // namespace farcell
