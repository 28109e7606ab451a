// A synthetic pack, opened and drawn.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <memory>

#include "runtime/renderer.h"
#include "tests/support/synthetic_pack.h"

namespace farcell {

inline constexpr uint64_t kPlentyBytes = 256'000'000;

// One context for the whole program: all tests run on its thread.
inline GlContext& sharedContext() {
  static Result<GlContext> context = GlContext::createHeadless();
  if (!context) throw std::runtime_error(context.error().message);
  return *context;
}

struct DrawnPack {
  std::unique_ptr<PackFile> pack;
  std::unique_ptr<Renderer> renderer;

  FrameStats draw(const Camera& camera, const RenderSettings& settings, FrameImage& image) {
    const auto stats = renderer->draw(camera, settings, &image);
    if (!stats) throw std::runtime_error(stats.error().message);
    return *stats;
  }
};

inline DrawnPack openDrawn(const std::vector<SyntheticTriangle>& triangles, const SyntheticPack& settings,
                           uint64_t residentBytes = kPlentyBytes) {
  const std::string name = fmt::format("farcell_renderer_{}_{}.far", ::testing::UnitTest::GetInstance()->random_seed(),
                                       static_cast<int>(getpid()));
  const auto path = std::filesystem::temp_directory_path() / name;
  const auto written = writeSyntheticPack(path, triangles, settings);
  if (!written) throw std::runtime_error(written.error().message);
  auto opened = PackFile::open(path);
  std::filesystem::remove(path);
  if (!opened) throw std::runtime_error(opened.error().message);
  DrawnPack result;
  result.pack = std::make_unique<PackFile>(std::move(*opened));
  auto renderer = Renderer::create(sharedContext(), *result.pack, residentBytes);
  if (!renderer) throw std::runtime_error(renderer.error().message);
  result.renderer = std::make_unique<Renderer>(std::move(*renderer));
  return result;
}

inline RenderSettings sized(int width, int height, RenderMode mode, int samples = 4,
                            ImpostorKind kind = ImpostorKind::depthCorrected) {
  RenderSettings settings;
  settings.width = width;
  settings.height = height;
  settings.samplesPerPixel = samples;
  settings.kind = kind;
  settings.selection.mode = mode;
  return settings;
}

inline Camera lookAt(glm::dvec3 position, glm::dvec3 target, double fovYRad = 0.7) {
  return {"test", position, target, glm::dvec3(0, 0, 1), fovYRad};
}

inline int alphaAt(const FrameImage& image, int x, int y) {
  return image.rgba[static_cast<size_t>((y * image.width + x) * 4 + 3)];
}

// Sum of coverage in pixels.
inline double coveredPixels(const FrameImage& image) {
  double sum = 0;
  for (size_t i = 3; i < image.rgba.size(); i += 4) sum += image.rgba[i] / 255.0;
  return sum;
}

struct Difference {
  int worst = 0;
  double mean = 0;  // of all bytes
};

inline Difference difference(const FrameImage& a, const FrameImage& b) {
  Difference result;
  for (size_t i = 0; i < a.rgba.size(); ++i) {
    const int d = std::abs(a.rgba[i] - b.rgba[i]);
    result.worst = std::max(result.worst, d);
    result.mean += d;
  }
  result.mean /= static_cast<double>(a.rgba.size());
  return result;
}

}  // namespace farcell
