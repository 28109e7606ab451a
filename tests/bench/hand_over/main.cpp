// bench_hand_over <pack> [steps]: how much pictures change, step by step, along a turn about the model and along a
// dolly to it, against 16 samples of the full geometry; CSV. A pop is a step that changes more than the truth does;
// flicker is the mean difference between both changes.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <glm/geometric.hpp>
#include <numbers>
#include <string>

#include "runtime/renderer.h"

namespace farcell {
namespace {

constexpr uint64_t kResidentBytes = 2'000'000'000;
constexpr double kTurnRad = 0.5 * std::numbers::pi / 180;
constexpr double kDollyFactor = 0.98;
constexpr double kFovYRad = 0.7;

struct Way {
  const char* name;
  RenderMode mode;
  bool handOver;
};
constexpr std::array kWays = {Way{"full 4 samples", RenderMode::full, false}, Way{"auto", RenderMode::automatic, false},
                              Way{"auto handed over", RenderMode::automatic, true},
                              Way{"A", RenderMode::impostors, false},
                              Way{"A handed over", RenderMode::impostors, true}};

using Picture = std::vector<uint8_t>;  // RGB over the default background

Result<Picture> drawn(Renderer& renderer, const Camera& camera, const Way& way, int samples, FrameStats& stats) {
  RenderSettings settings;
  settings.selection.mode = way.mode;
  settings.samplesPerPixel = samples;
  settings.handOver = way.handOver;
  FrameImage image;
  FARCELL_ASSIGN(stats, renderer.draw(camera, settings, &image));
  return overBackground(image.rgba, kDefaultBackground);
}

// Along one path, of one way.
struct Sums {
  double error = 0, change = 0, worstChange = 0, flicker = 0;
  std::vector<double> milliseconds;
};

// One step of one way: two pictures and those of the truth. Sums are over bytes.
void addStep(const Picture& before, const Picture& after, const Picture& trueBefore, const Picture& trueAfter,
             Sums& sums) {
  double change = 0, truth = 0;
  for (size_t i = 0; i < before.size(); ++i) {
    const int own = after[i] - before[i], expected = trueAfter[i] - trueBefore[i];
    change += std::abs(own);
    truth += std::abs(expected);
    sums.flicker += std::abs(own - expected);
    sums.error += std::abs(after[i] - trueAfter[i]);
  }
  sums.change += change / truth;
  sums.worstChange = std::max(sums.worstChange, change / truth);
}

Result<> along(Renderer& renderer, const char* name, const std::vector<Camera>& path) {
  std::array<Sums, kWays.size()> all;
  std::array<Picture, kWays.size() + 1> before, after;
  for (size_t step = 0; step < path.size(); ++step) {
    FrameStats stats;
    FARCELL_ASSIGN(after.back(), drawn(renderer, path[step], kWays[0], 16, stats));
    for (size_t way = 0; way < kWays.size(); ++way) {
      FARCELL_ASSIGN(after[way], drawn(renderer, path[step], kWays[way], 4, stats));
      all[way].milliseconds.push_back(stats.cpuMs);
      if (step > 0) addStep(before[way], after[way], before.back(), after.back(), all[way]);
    }
    std::swap(before, after);
  }
  const double steps = static_cast<double>(path.size() - 1), bytes = static_cast<double>(before[0].size());
  for (size_t way = 0; way < kWays.size(); ++way) {
    Sums& sums = all[way];
    std::sort(sums.milliseconds.begin(), sums.milliseconds.end());
    std::printf("%s,%s,%.3f,%.3f,%.3f,%.3f,%.1f\n", name, kWays[way].name, sums.change / steps, sums.worstChange,
                sums.flicker / steps / bytes, sums.error / steps / bytes,
                sums.milliseconds[sums.milliseconds.size() / 2]);
  }
  std::fflush(stdout);
  return {};
}

Result<> bench(const char* path, int steps) {
  FARCELL_ASSIGN(const PackFile pack, PackFile::open(path));
  FARCELL_ASSIGN(GlContext context, GlContext::createHeadless());
  FARCELL_ASSIGN(Renderer renderer, Renderer::create(context, pack, kResidentBytes));
  const Model& model = pack.directory().model;
  const glm::dvec3 min = model.grid.worldFromGrid(model.bounds.min), max = model.grid.worldFromGrid(model.bounds.max);
  const glm::dvec3 middle = (min + max) * 0.5, up = upVector(model.settings.up);
  const glm::dvec3 side = model.settings.up == UpAxis::y ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0);
  const glm::dvec3 other = glm::cross(up, side);
  std::vector<Camera> turn, dolly;
  for (int i = 0; i <= steps; ++i) {
    const auto eye = [&](double angleRad, double diameters) {
      const glm::dvec3 level = std::cos(angleRad) * side + std::sin(angleRad) * other;
      return middle + glm::normalize(level + 0.5 * up) * (diameters * glm::length(max - min));
    };
    turn.push_back({"", eye(0.3 + i * kTurnRad, 1.2), middle, up, kFovYRad});
    dolly.push_back({"", eye(0.9, 2.5 * std::pow(kDollyFactor, i)), middle, up, kFovYRad});
  }
  std::printf("path,way,change over the truth's,worst,flicker,error,cpuMs\n");
  FARCELL_TRY(along(renderer, "turn", turn));
  return along(renderer, "dolly", dolly);
}

}  // namespace
}  // namespace farcell

int main(int argc, char** argv) {
  if (argc < 2) {
    std::fprintf(stderr, "usage: bench_hand_over <pack> [steps]\n");
    return 2;
  }
  const auto result = farcell::bench(argv[1], argc > 2 ? std::max(1, std::atoi(argv[2])) : 40);
  if (!result) std::fprintf(stderr, "bench_hand_over: %s\n", result.error().message.c_str());
  return result ? 0 : 1;
}
