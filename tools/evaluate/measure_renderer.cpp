#include "tools/evaluate/measure_renderer.h"

#include <glm/geometric.hpp>

#include "cache/base/interrupt.h"

namespace farcell {
namespace {

double eyeDiameters(const Model& model, const Camera& camera) {
  const glm::dvec3 min = model.grid.worldFromGrid(model.bounds.min), max = model.grid.worldFromGrid(model.bounds.max);
  const double diameter = glm::length(max - min);
  return diameter > 0 ? (glm::length(camera.position - (min + max) * 0.5) - diameter / 2) / diameter : 0;
}

Result<> timeFrames(Renderer& renderer, const Camera& camera, const RenderSettings& settings, int frames,
                    Entry& entry) {
  std::vector<double> wallMs, cpuMs;
  for (int frame = 0; frame < frames; ++frame) {
    FARCELL_TRY(checkInterrupt());
    FARCELL_ASSIGN(const FrameStats stats, renderer.draw(camera, settings, nullptr));
    wallMs.push_back(stats.wallMs);
    cpuMs.push_back(stats.cpuMs);
  }
  entry.frame = frameTimes(wallMs);
  entry.cpuMs = medianOf(cpuMs);
  return {};
}

}  // namespace

Result<Measurement> measureRenderer(GlContext& context, const PackFile& pack, const Camera& camera,
                                    const RendererPlan& plan, const ReferenceImage& reference,
                                    const MeasureSettings& settings) {
  FARCELL_ASSIGN(Renderer renderer, Renderer::create(context, pack, settings.residentBytes));
  Measurement result;
  Entry& entry = result.entry;
  entry.camera = camera.name;
  entry.renderer = plan;
  entry.diameters = eyeDiameters(pack.directory().model, camera);
  FARCELL_ASSIGN(const FrameStats cold, renderer.draw(camera, plan.settings, nullptr));
  entry.bytesRead = cold.bytesRead;
  FARCELL_TRY(timeFrames(renderer, camera, plan.settings, settings.timedFrames, entry));
  FARCELL_ASSIGN(const FrameStats last, renderer.draw(camera, plan.settings, &result.image));
  entry.triangles = last.triangles;
  entry.meshes = last.meshes;
  entry.impostors = last.impostors;
  entry.texels = last.texels;
  const TestImage test{result.image.width, result.image.height, result.image.rgba, result.image.impostorCoverage};
  entry.metrics = measure(reference, test, settings.background, &result.flip);
  return result;
}

}  // namespace farcell
