// bench_cost <pack> <camera file, or how many automatic cameras> [frames]: what calibration measures and takes, then
// what frames were expected to take and took, CSV on stdout. 1280 x 720.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <string>

#include "runtime/calibration/calibration.h"
#include "runtime/renderer.h"
#include "tests/bench/bench_cameras.h"

namespace farcell {
namespace {

constexpr uint64_t kResidentBytes = 2'000'000'000;
constexpr const char* kKinds[] = {"flat", "A", "B"};

Result<CostModel> calibrate(GlContext& context) {
  const auto start = std::chrono::steady_clock::now();
  FARCELL_ASSIGN(const CostModel costs, measureCosts(context));
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  std::printf(
      "# calibration: %.2f s\n# kind,samples,picturePixelNs,triangleNs,meshPixelNs,impostorNs,impostorPixelNs\n",
      seconds);
  for (size_t kind = 0; kind < 3; ++kind)
    for (const int samples : {1, 4}) {
      const DrawCosts& draw = costs.of(kind, samples > 1);
      std::printf("# %s,%d,%.2f,%.1f,%.2f,%.0f,%.2f\n", kKinds[kind], samples, 1e6 * draw.picturePixelMs,
                  1e6 * draw.triangleMs, 1e6 * draw.meshPixelMs, 1e6 * draw.impostorMs, 1e6 * draw.impostorPixelMs);
    }
  return costs;
}

Result<> benchFrame(Renderer& renderer, const Camera& camera, RenderSettings settings, const char* mode, int frames) {
  std::vector<double> wallMs;
  FrameStats stats;
  for (int frame = -1; frame < frames; ++frame) {
    FARCELL_ASSIGN(stats, renderer.draw(camera, settings, nullptr));
    if (frame >= 0) wallMs.push_back(stats.wallMs);
  }
  std::sort(wallMs.begin(), wallMs.end());
  std::printf("%s,%s,%s,%d,%g,%.2f,%.2f,%.2f,%.0f,%.0f,%.0f,%.0f\n", camera.name.c_str(), mode,
              kKinds[static_cast<size_t>(settings.kind)], settings.samplesPerPixel, settings.selection.timeBudgetMs,
              stats.expectedMs, wallMs[wallMs.size() / 2], wallMs[0], stats.work.triangles, stats.work.meshPixels,
              stats.work.impostors, stats.work.impostorPixels);
  std::fflush(stdout);
  return {};
}

Result<> bench(const std::string& path, const std::string& words, int frames) {
  FARCELL_ASSIGN(const PackFile pack, PackFile::open(path));
  FARCELL_ASSIGN(const std::vector<Camera> cameras, loadCameras(words, pack.directory().model));
  FARCELL_ASSIGN(GlContext context, GlContext::createHeadless());
  RenderSettings settings;
  FARCELL_ASSIGN(settings.costs, calibrate(context));
  FARCELL_ASSIGN(Renderer renderer, Renderer::create(context, pack, kResidentBytes));
  std::printf(
      "camera,mode,kind,samples,budgetMs,expectedMs,medianMs,leastMs,triangles,meshPixels,impostors,"
      "impostorPixels\n");
  for (const Camera& camera : cameras)
    for (const int samples : {1, 4}) {
      settings.samplesPerPixel = samples;
      for (const ImpostorKind kind : {ImpostorKind::flat, ImpostorKind::depthCorrected, ImpostorKind::blended}) {
        settings.kind = kind;
        settings.selection.timeBudgetMs = 0;
        FARCELL_TRY(benchFrame(renderer, camera, settings, "auto", frames));
        settings.selection.timeBudgetMs = 50;
        FARCELL_TRY(benchFrame(renderer, camera, settings, "auto", frames));
      }
    }
  return {};
}

}  // namespace
}  // namespace farcell

int main(int argc, char** argv) {
  if (argc < 3) {
    std::fprintf(stderr, "usage: bench_cost <pack> <cameras.json or a number> [frames]\n");
    return 2;
  }
  const auto result = farcell::bench(argv[1], argv[2], argc > 3 ? std::max(1, std::atoi(argv[3])) : 5);
  if (!result) std::fprintf(stderr, "bench_cost: %s\n", result.error().message.c_str());
  return result ? 0 : 1;
}
