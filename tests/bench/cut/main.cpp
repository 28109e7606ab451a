// bench_cut <pack> <camera file, or how many automatic cameras> [every nth camera] [frames]: error, triangles and time
// of cuts with and without simplified meshes, CSV on stdout, a line for each camera and way of drawing. 1280 x 720,
// against 64 samples. The ways take turns with each frame, so that what else the machine does falls on all alike.
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <string>

#include "runtime/renderer.h"
#include "tests/bench/bench_cameras.h"
#include "tools/evaluate/metrics/metrics.h"
#include "tools/evaluate/reference/reference.h"

namespace farcell {
namespace {

constexpr uint64_t kResidentBytes = 2'000'000'000;
constexpr Colour kBackground = {179, 204, 230};

struct Way {
  std::string name;
  RenderSettings settings;
};

Way automatic(double millisecondPrice, uint64_t triangleBudget, double timeBudgetMs = 0) {
  Way result{fmt::format("auto-price-{}-triangles-{}k-ms-{}", millisecondPrice, triangleBudget / 1000, timeBudgetMs),
             {}};
  result.settings.selection.millisecondPrice = millisecondPrice;
  result.settings.selection.triangleBudget = triangleBudget;
  result.settings.selection.timeBudgetMs = timeBudgetMs;
  return result;
}

Way way(const std::string& name, RenderMode mode, int samples, double meshPixels, double texelPixels = kTexelPixels) {
  Way result{name, {}};
  result.settings.samplesPerPixel = samples;
  result.settings.selection.mode = mode;
  result.settings.selection.meshPixels = meshPixels;
  result.settings.selection.texelPixels = texelPixels;
  return result;
}

std::vector<Way> allWays() {
  std::vector<Way> ways = {way("full-1spp", RenderMode::full, 1, 0), way("full-4spp", RenderMode::full, 4, 0)};
  ways.push_back(way("A-0.5px", RenderMode::impostors, 4, 0, 0.5));
  ways.push_back(way("lod-1px", RenderMode::meshes, 4, 1));
  ways.push_back(way("auto-no-meshes", RenderMode::automatic, 4, 0));
  for (const double price : {0.0, 4.0, 8.0, 16.0, 28.0}) ways.push_back(automatic(price, 500'000));
  for (const uint64_t budget : {250'000, 1'000'000, 2'000'000}) ways.push_back(automatic(kMillisecondPrice, budget));
  for (const double ms : {50.0, 100.0, 200.0, 400.0}) ways.push_back(automatic(0, 1'000'000'000, ms));
  return ways;
}

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

Result<> benchCamera(Renderer& renderer, const Camera& camera, const ReferenceImage& reference, int frames) {
  const std::vector<Way> ways = allWays();
  std::vector<std::vector<double>> wallMs(ways.size()), cpuMs(ways.size());
  std::vector<FrameStats> stats(ways.size());
  for (int frame = -1; frame < frames; ++frame)
    for (size_t i = 0; i < ways.size(); ++i) {
      FARCELL_ASSIGN(stats[i], renderer.draw(camera, ways[i].settings, nullptr));
      if (frame < 0) continue;  // reads the pack
      wallMs[i].push_back(stats[i].wallMs);
      cpuMs[i].push_back(stats[i].cpuMs);
    }
  double baseline = 0;
  for (size_t i = 0; i < ways.size(); ++i) {
    FrameImage image;
    FARCELL_TRY(renderer.draw(camera, ways[i].settings, &image));
    const Metrics metrics =
        measure(reference, {image.width, image.height, image.rgba, image.impostorCoverage}, kBackground, nullptr);
    if (i == 0) baseline = metrics.paperError;
    std::printf("%s,%s,%.4f,%.4f,%.4f,%.2f,%.2f,%.2f,%.4f,%.4f,%llu,%llu,%llu\n", camera.name.c_str(),
                ways[i].name.c_str(), metrics.paperError / baseline, 100 * metrics.holeRate, metrics.impostorShare,
                median(wallMs[i]), median(cpuMs[i]), stats[i].expectedMs, stats[i].expectedLoss, stats[i].lossBound,
                static_cast<unsigned long long>(stats[i].triangles), static_cast<unsigned long long>(stats[i].meshes),
                static_cast<unsigned long long>(stats[i].impostors));
    std::fflush(stdout);
  }
  return {};
}

Result<> bench(const std::string& path, const std::string& words, size_t every, int frames) {
  FARCELL_ASSIGN(const PackFile pack, PackFile::open(path));
  FARCELL_ASSIGN(const std::vector<Camera> cameras, loadCameras(words, pack.directory().model));
  FARCELL_ASSIGN(GlContext context, GlContext::createHeadless());
  FARCELL_ASSIGN(Renderer renderer, Renderer::create(context, pack, kResidentBytes));
  std::printf(
      "camera,way,ratioToFull1spp,holePercent,impostorShare,wallMs,cpuMs,expectedMs,expectedLoss,lossBound,triangles,"
      "meshes,impostors\n");
  for (size_t i = 0; i < cameras.size(); i += every) {
    FARCELL_ASSIGN(const ReferenceImage reference, traceReference(pack, cameras[i], {}));
    FARCELL_TRY(benchCamera(renderer, cameras[i], reference, frames));
  }
  return {};
}

}  // namespace
}  // namespace farcell

int main(int argc, char** argv) {
  if (argc < 3) {
    std::fprintf(stderr, "usage: bench_cut <pack> <cameras.json or a number> [every nth camera] [frames]\n");
    return 2;
  }
  const auto every = static_cast<size_t>(argc > 3 ? std::max(1, std::atoi(argv[3])) : 1);
  const auto result = farcell::bench(argv[1], argv[2], every, argc > 4 ? std::max(1, std::atoi(argv[4])) : 5);
  if (!result) std::fprintf(stderr, "bench_cut: %s\n", result.error().message.c_str());
  return result ? 0 : 1;
}
