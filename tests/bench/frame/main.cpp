// bench_frame <pack> [frames]: warm frame times of an overview at 1280 x 720, CSV on stdout.
#include <algorithm>
#include <cstdio>
#include <cstdlib>

#include "runtime/camera/overview.h"
#include "runtime/renderer.h"

namespace farcell {
namespace {

constexpr uint64_t kResidentBytes = 2'000'000'000;

struct Run {
  const char* name;
  RenderMode mode;
  ImpostorKind kind;
  int samples;
};

constexpr Run kRuns[] = {{"full-1spp", RenderMode::full, ImpostorKind::flat, 1},
                         {"auto-flat-1spp", RenderMode::automatic, ImpostorKind::flat, 1},
                         {"auto-A-1spp", RenderMode::automatic, ImpostorKind::depthCorrected, 1},
                         {"impostors-flat-1spp", RenderMode::impostors, ImpostorKind::flat, 1},
                         {"impostors-A-1spp", RenderMode::impostors, ImpostorKind::depthCorrected, 1},
                         {"full-4spp", RenderMode::full, ImpostorKind::flat, 4},
                         {"auto-flat", RenderMode::automatic, ImpostorKind::flat, 4},
                         {"auto-A", RenderMode::automatic, ImpostorKind::depthCorrected, 4},
                         {"impostors-flat", RenderMode::impostors, ImpostorKind::flat, 4},
                         {"impostors-A", RenderMode::impostors, ImpostorKind::depthCorrected, 4}};

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

Result<> bench(const char* path, int frames) {
  FARCELL_ASSIGN(const PackFile pack, PackFile::open(path));
  FARCELL_ASSIGN(GlContext context, GlContext::createHeadless());
  FARCELL_ASSIGN(Renderer renderer, Renderer::create(context, pack, kResidentBytes));
  const Model& model = pack.directory().model;
  const Camera camera =
      overviewCamera(model.grid.worldFromGrid(model.bounds.min), model.grid.worldFromGrid(model.bounds.max),
                     upVector(model.settings.up), 16.0 / 9);
  std::printf("renderer,medianWallMs,minWallMs,medianCpuMs,triangles,impostors,texels\n");
  for (const Run& run : kRuns) {
    RenderSettings settings;
    settings.samplesPerPixel = run.samples;
    settings.kind = run.kind;
    settings.selection.mode = run.mode;
    std::vector<double> wallMs, cpuMs;
    FrameStats stats;
    for (int i = -1; i < frames; ++i) {
      FARCELL_ASSIGN(stats, renderer.draw(camera, settings, nullptr));
      if (i < 0) continue;  // reads the pack
      wallMs.push_back(stats.wallMs);
      cpuMs.push_back(stats.cpuMs);
    }
    std::printf("%s,%.2f,%.2f,%.2f,%llu,%llu,%llu\n", run.name, median(wallMs),
                *std::min_element(wallMs.begin(), wallMs.end()), median(cpuMs),
                static_cast<unsigned long long>(stats.triangles), static_cast<unsigned long long>(stats.impostors),
                static_cast<unsigned long long>(stats.texels));
  }
  return {};
}

}  // namespace
}  // namespace farcell

int main(int argc, char** argv) {
  if (argc < 2) {
    std::fprintf(stderr, "usage: bench_frame <pack> [frames]\n");
    return 2;
  }
  const auto result = farcell::bench(argv[1], argc > 2 ? std::max(1, std::atoi(argv[2])) : 15);
  if (!result) std::fprintf(stderr, "bench_frame: %s\n", result.error().message.c_str());
  return result ? 0 : 1;
}
