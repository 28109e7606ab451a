// bench_impostors <pack> <cameras.json> [frames]: the kinds of impostors against 16 samples of the full geometry, CSV.
// Error from each camera; and pop: how much pictures change when the eye turns by half a degree about the model, across
// an edge between two triangles of views or across the border where another view becomes the nearest.
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
constexpr double kStepRad = 0.5 * std::numbers::pi / 180;
constexpr int kCrossings = 8;       // of each sort
constexpr double kPopDistance = 4;  // from the middle, diameters
constexpr double kPopFovYRad = 0.35;
constexpr double kWholeModel = 1000;  // texels as large as that on screen are far enough: the root is the impostor

struct Way {
  const char* name;
  RenderMode mode;
  ImpostorKind kind;
};
constexpr std::array kWays = {Way{"A", RenderMode::impostors, ImpostorKind::depthCorrected},
                              Way{"B", RenderMode::impostors, ImpostorKind::blended},
                              Way{"auto A", RenderMode::automatic, ImpostorKind::depthCorrected},
                              Way{"auto B", RenderMode::automatic, ImpostorKind::blended}};

RenderSettings settingsOf(RenderMode mode, ImpostorKind kind, int samples) {
  RenderSettings settings;
  settings.selection.mode = mode;
  settings.kind = kind;
  settings.samplesPerPixel = samples;
  return settings;
}

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

struct Comparison {
  double error = 0;  // sum of |dR| + |dG| + |dB| over the default background
  double holes = 0, leaks = 0, foreground = 0;
  double coverage = 0, expectedCoverage = 0;
};

// The metrics of `farcell evaluate`, summed.
void compare(const FrameImage& reference, const FrameImage& found, Comparison& sum) {
  const std::vector<uint8_t> a = overBackground(reference.rgba, kDefaultBackground);
  const std::vector<uint8_t> b = overBackground(found.rgba, kDefaultBackground);
  for (size_t i = 0; i < a.size(); ++i) sum.error += std::abs(a[i] - b[i]);
  for (size_t i = 3; i < reference.rgba.size(); i += 4) {
    const double expected = reference.rgba[i] / 255.0, own = found.rgba[i] / 255.0;
    sum.foreground += expected > 0;
    sum.holes += expected > 0.999 && own < 0.5;
    sum.leaks += expected == 0 && own > 0.02;
    sum.coverage += own;
    sum.expectedCoverage += expected;
  }
}

// Mean over the pixels of `foreground`, of a channel.
double change(const FrameImage& from, const FrameImage& to, double foregroundPixels) {
  Comparison sum;
  compare(from, to, sum);
  return sum.error / (3 * foregroundPixels);
}

Result<> errors(Renderer& renderer, const std::vector<Camera>& cameras, int frames) {
  std::printf("camera,way,ratioToFull1spp,holes %%,leaks %%,coverage bias %%,cpuMs,wallMs,impostors\n");
  for (const Camera& camera : cameras) {
    FrameImage reference, found;
    FARCELL_TRY(renderer.draw(camera, settingsOf(RenderMode::full, ImpostorKind::flat, 16), &reference));
    FARCELL_TRY(renderer.draw(camera, settingsOf(RenderMode::full, ImpostorKind::flat, 1), &found));
    Comparison baseline;
    compare(reference, found, baseline);
    std::array<std::vector<double>, kWays.size()> cpuMs, wallMs;
    std::array<FrameStats, kWays.size()> stats;
    for (int i = 0; i < frames; ++i)
      for (size_t way = 0; way < kWays.size(); ++way) {
        // The first reads the pack and makes the target.
        const RenderSettings settings = settingsOf(kWays[way].mode, kWays[way].kind, 4);
        FARCELL_TRY(renderer.draw(camera, settings, nullptr));
        FARCELL_ASSIGN(stats[way], renderer.draw(camera, settings, nullptr));
        cpuMs[way].push_back(stats[way].cpuMs);
        wallMs[way].push_back(stats[way].wallMs);
      }
    for (size_t way = 0; way < kWays.size(); ++way) {
      FARCELL_TRY(renderer.draw(camera, settingsOf(kWays[way].mode, kWays[way].kind, 4), &found));
      Comparison sum;
      compare(reference, found, sum);
      std::printf("%s,%s,%.3f,%.3f,%.2f,%.2f,%.1f,%.1f,%llu\n", camera.name.c_str(), kWays[way].name,
                  sum.error / baseline.error, 100 * sum.holes / sum.foreground, 100 * sum.leaks / sum.foreground,
                  100 * (sum.coverage / sum.expectedCoverage - 1), median(cpuMs[way]), median(wallMs[way]),
                  static_cast<unsigned long long>(stats[way].impostors));
      std::fflush(stdout);
    }
  }
  return {};
}

struct Crossing {
  const char* border;
  glm::dvec3 before, after;  // directions from the middle of the model
};

// From the middles of triangles across an edge's middle; and, within a triangle, across its axis of symmetry.
std::vector<Crossing> crossings(const Viewpoints& viewpoints) {
  std::vector<Crossing> result;
  for (int i = 0; i < kCrossings; ++i) {
    // Directions spread evenly: a spiral (Fibonacci), away from straight up and down.
    const double height = 0.9 * (2 * (i + 0.5) / kCrossings - 1), azimuth = i * 2.399963;
    const glm::dvec3 direction(std::sqrt(1 - height * height) * std::cos(azimuth),
                               std::sqrt(1 - height * height) * std::sin(azimuth), height);
    const auto triple = viewpoints.nearestThree(direction);
    const auto& all = viewpoints.directions();
    const glm::dvec3 a = all[triple.views[0]], b = all[triple.views[1]], c = all[triple.views[2]];
    const glm::dvec3 onEdge = glm::normalize(0.7 * a + 0.3 * b);
    const glm::dvec3 acrossEdge = glm::normalize(glm::cross(a, b)) * std::copysign(1.0, glm::dot(glm::cross(a, b), c));
    result.push_back({"triangle", onEdge + acrossEdge * (kStepRad / 2), onEdge - acrossEdge * (kStepRad / 2)});
    const glm::dvec3 onAxis = glm::normalize(0.4 * (a + b) + 0.2 * c);
    const glm::dvec3 acrossAxis = glm::normalize(a - b);
    result.push_back({"nearest", onAxis + acrossAxis * (kStepRad / 2), onAxis - acrossAxis * (kStepRad / 2)});
  }
  return result;
}

Result<> pops(const PackFile& pack, Renderer& renderer) {
  const Model& model = pack.directory().model;
  FARCELL_ASSIGN(const Viewpoints viewpoints, Viewpoints::create(model.settings.form.views));
  if (!viewpoints.hasTriangles()) return {};
  // The content's middle: what selection measures directions from, where the root is the impostor.
  const glm::dvec3 min = model.grid.worldFromGrid(model.bounds.min), max = model.grid.worldFromGrid(model.bounds.max);
  std::printf("border,cells,way,change of the reference,change,times the reference's\n");
  for (const double texelPixels : {kWholeModel, kTexelPixels})
    for (const Crossing& crossing : crossings(viewpoints)) {
      const auto cameraAt = [&](glm::dvec3 direction) {
        return Camera{"", (min + max) * 0.5 + glm::normalize(direction) * (kPopDistance * glm::length(max - min)),
                      (min + max) * 0.5, upVector(model.settings.up), kPopFovYRad};
      };
      const std::array<Camera, 2> eyes = {cameraAt(crossing.before), cameraAt(crossing.after)};
      std::array<FrameImage, 2> reference, found;
      for (size_t i = 0; i < 2; ++i)
        FARCELL_TRY(renderer.draw(eyes[i], settingsOf(RenderMode::full, ImpostorKind::flat, 16), &reference[i]));
      Comparison self;
      compare(reference[0], reference[0], self);
      const double expected = change(reference[0], reference[1], self.foreground);
      for (const Way& way : {kWays[0], kWays[1]}) {
        RenderSettings settings = settingsOf(way.mode, way.kind, 4);
        settings.selection.texelPixels = texelPixels;
        for (size_t i = 0; i < 2; ++i) FARCELL_TRY(renderer.draw(eyes[i], settings, &found[i]));
        const double own = change(found[0], found[1], self.foreground);
        std::printf("%s,%s,%s,%.3f,%.3f,%.3f\n", crossing.border, texelPixels == kWholeModel ? "root" : "cut", way.name,
                    expected, own, own / expected);
      }
      std::fflush(stdout);
    }
  return {};
}

Result<> bench(const char* path, const char* camerasPath, int frames) {
  FARCELL_ASSIGN(const PackFile pack, PackFile::open(path));
  FARCELL_ASSIGN(const std::vector<Camera> cameras, readCameras(camerasPath));
  FARCELL_ASSIGN(GlContext context, GlContext::createHeadless());
  FARCELL_ASSIGN(Renderer renderer, Renderer::create(context, pack, kResidentBytes));
  FARCELL_TRY(errors(renderer, cameras, frames));
  return pops(pack, renderer);
}

}  // namespace
}  // namespace farcell

int main(int argc, char** argv) {
  if (argc < 3) {
    std::fprintf(stderr, "usage: bench_impostors <pack> <cameras.json> [frames]\n");
    return 2;
  }
  const auto result = farcell::bench(argv[1], argv[2], argc > 3 ? std::max(2, std::atoi(argv[3])) : 6);
  if (!result) std::fprintf(stderr, "bench_impostors: %s\n", result.error().message.c_str());
  return result ? 0 : 1;
}
