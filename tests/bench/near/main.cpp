// bench_near <pack> <cameras.json> [camera...]: pictures of mode auto at several numbers of samples, and of 4 samples
// with a history, against full geometry at 64 samples; CSV. The history is that of a camera that turns on its spot by
// half a degree a frame up to the camera's pose, brought to each next frame by the turn alone: nothing that was hidden
// comes into view, so that a history does here what it can do at best. Ratios are root mean squares of differences over
// that of full geometry at 1 sample.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <glm/geometric.hpp>
#include <numbers>
#include <set>
#include <string>

#include "runtime/renderer.h"

namespace farcell {
namespace {

constexpr uint64_t kResidentBytes = 2'000'000'000;
constexpr double kTurnRad = 0.5 * std::numbers::pi / 180;
constexpr int kFrames = 12;
constexpr int kWidth = 1280, kHeight = 720;

// How a history is read and mixed with a frame.
struct Way {
  const char* name;
  double share;  // of the frame
  bool cubic;    // Catmull-Rom; else linear
  bool clamped;  // to what the 3 x 3 pixels of the frame hold
};
constexpr std::array kWays = {
    Way{"linear, 1/4", 0.25, false, false},        Way{"cubic, 1/4", 0.25, true, false},
    Way{"cubic, 1/8", 0.125, true, false},         Way{"cubic, 1/4, clamped", 0.25, true, true},
    Way{"cubic, 1/8, clamped", 0.125, true, true}, Way{"cubic, 1/2, clamped", 0.5, true, true}};

struct Picture {
  std::vector<float> rgb = std::vector<float>(size_t{kWidth} * kHeight * 3);
  float at(int x, int y, int channel) const {
    x = std::clamp(x, 0, kWidth - 1), y = std::clamp(y, 0, kHeight - 1);
    return rgb[(static_cast<size_t>(y) * kWidth + static_cast<size_t>(x)) * 3 + static_cast<size_t>(channel)];
  }
};

Result<Picture> drawn(Renderer& renderer, const Camera& camera, RenderMode mode, int samples, double* cpuMs = nullptr) {
  RenderSettings settings;
  settings.width = kWidth;
  settings.height = kHeight;
  settings.selection.mode = mode;
  settings.samplesPerPixel = samples;
  if (cpuMs != nullptr) {
    FARCELL_TRY(renderer.draw(camera, settings, nullptr));
    FARCELL_ASSIGN(const FrameStats stats, renderer.draw(camera, settings, nullptr));
    *cpuMs = stats.cpuMs;
  }
  FrameImage image;
  FARCELL_TRY(renderer.draw(camera, settings, &image));
  Picture picture;
  const std::vector<uint8_t> bytes = overBackground(image.rgba, kDefaultBackground);
  std::copy(bytes.begin(), bytes.end(), picture.rgb.begin());
  return picture;
}

double rms(const Picture& picture, const Picture& truth) {
  double sum = 0;
  for (size_t i = 0; i < truth.rgb.size(); ++i) {
    const double d = static_cast<double>(picture.rgb[i] - truth.rgb[i]);
    sum += d * d;
  }
  return std::sqrt(sum / static_cast<double>(truth.rgb.size()));
}

Camera turned(const Camera& camera, double angleRad) {
  const CameraAxes axes = cameraAxes(camera);
  Camera result = camera;
  const double length = glm::length(camera.target - camera.position);
  result.target = camera.position + length * (std::sin(angleRad) * axes.right - std::cos(angleRad) * axes.back);
  result.up = axes.up;
  return result;
}

// Of four points -1 .. 2 at t in [0, 1).
std::array<double, 4> weightsAt(double t, bool cubic) {
  if (!cubic) return {0, 1 - t, t, 0};
  return {((-t + 2) * t - 1) * t / 2, ((3 * t - 5) * t * t + 2) / 2, ((-3 * t + 4) * t + 1) * t / 2,
          (t - 1) * t * t / 2};
}

float sampled(const Picture& picture, double x, double y, int channel, bool cubic) {
  const int left = static_cast<int>(std::floor(x - 0.5)), top = static_cast<int>(std::floor(y - 0.5));
  const auto wx = weightsAt(x - 0.5 - left, cubic), wy = weightsAt(y - 0.5 - top, cubic);
  double sum = 0;
  for (int j = 0; j < 4; ++j)
    for (int i = 0; i < 4; ++i)
      if (wx[static_cast<size_t>(i)] != 0 && wy[static_cast<size_t>(j)] != 0)
        sum += wx[static_cast<size_t>(i)] * wy[static_cast<size_t>(j)] *
               static_cast<double>(picture.at(left - 1 + i, top - 1 + j, channel));
  return static_cast<float>(sum);
}

// Where a direction of one camera's pixel lies in the other's picture.
glm::dvec2 reprojected(const CameraAxes& from, const CameraAxes& to, double tanY, int x, int y) {
  const double scale = 2 * tanY / kHeight;
  const glm::dvec3 ray =
      from.right * ((x + 0.5 - kWidth / 2.0) * scale) + from.up * ((kHeight / 2.0 - y - 0.5) * scale) - from.back;
  const double ahead = -glm::dot(ray, to.back) * scale;
  return {glm::dot(ray, to.right) / ahead + kWidth / 2.0, kHeight / 2.0 - glm::dot(ray, to.up) / ahead};
}

float clampedTo(const Picture& frame, int x, int y, int channel, float value) {
  float low = 255, high = 0;
  for (int j = -1; j <= 1; ++j)
    for (int i = -1; i <= 1; ++i) {
      low = std::min(low, frame.at(x + i, y + j, channel));
      high = std::max(high, frame.at(x + i, y + j, channel));
    }
  return std::clamp(value, low, high);
}

Picture mixed(const Picture& frame, const Camera& camera, const Picture& history, const Camera& before,
              const Way& way) {
  const CameraAxes from = cameraAxes(camera), to = cameraAxes(before);
  const double tanY = std::tan(camera.fovYRad / 2);
  Picture result = frame;
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < kWidth; ++x) {
      const glm::dvec2 at = reprojected(from, to, tanY, x, y);
      if (!(at.x >= 0 && at.x < kWidth && at.y >= 0 && at.y < kHeight)) continue;
      for (int channel = 0; channel < 3; ++channel) {
        float old = sampled(history, at.x, at.y, channel, way.cubic);
        if (way.clamped) old = clampedTo(frame, x, y, channel, old);
        float& value =
            result.rgb[(static_cast<size_t>(y) * kWidth + static_cast<size_t>(x)) * 3 + static_cast<size_t>(channel)];
        value = static_cast<float>(way.share) * value + static_cast<float>(1 - way.share) * old;
      }
    }
  return result;
}

Result<> benchCamera(Renderer& renderer, const Camera& camera) {
  const auto report = [&](const char* what, double error, double cpuMs) {
    std::printf("%s,\"%s\",%.3f,%.0f\n", camera.name.c_str(), what, error, cpuMs);
    std::fflush(stdout);
  };
  FARCELL_ASSIGN(const Picture truth, drawn(renderer, camera, RenderMode::full, 64));
  FARCELL_ASSIGN(const Picture base, drawn(renderer, camera, RenderMode::full, 1));
  const double unit = rms(base, truth);
  for (const int samples : {4, 8, 16, 64}) {
    double cpuMs = 0;
    FARCELL_ASSIGN(const Picture picture, drawn(renderer, camera, RenderMode::automatic, samples, &cpuMs));
    report(fmt::format("{} samples", samples).c_str(), rms(picture, truth) / unit, cpuMs);
  }
  std::array<Picture, kWays.size()> histories;
  Camera before;
  for (int frame = 0; frame < kFrames; ++frame) {
    const Camera now = turned(camera, kTurnRad * (frame - kFrames + 1));
    FARCELL_ASSIGN(const Picture picture, drawn(renderer, now, RenderMode::automatic, 4));
    for (size_t way = 0; way < kWays.size(); ++way)
      histories[way] = frame == 0 ? picture : mixed(picture, now, histories[way], before, kWays[way]);
    before = now;
  }
  for (size_t way = 0; way < kWays.size(); ++way)
    report(fmt::format("4 and history: {}", kWays[way].name).c_str(), rms(histories[way], truth) / unit, 0);
  return {};
}

Result<> bench(const char* path, const char* cameraFile, const std::set<std::string>& names) {
  FARCELL_ASSIGN(const PackFile pack, PackFile::open(path));
  FARCELL_ASSIGN(const std::vector<Camera> cameras, readCameras(cameraFile));
  FARCELL_ASSIGN(GlContext context, GlContext::createHeadless());
  FARCELL_ASSIGN(Renderer renderer, Renderer::create(context, pack, kResidentBytes));
  std::printf("camera,picture,ratio,cpuMs\n");
  for (const Camera& camera : cameras)
    if (names.empty() || names.contains(camera.name)) FARCELL_TRY(benchCamera(renderer, camera));
  return {};
}

}  // namespace
}  // namespace farcell

int main(int argc, char** argv) {
  if (argc < 3) {
    std::fprintf(stderr, "usage: bench_near <pack> <cameras.json> [camera...]\n");
    return 2;
  }
  const auto result = farcell::bench(argv[1], argv[2], {argv + 3, argv + argc});
  if (!result) std::fprintf(stderr, "bench_near: %s\n", result.error().message.c_str());
  return result ? 0 : 1;
}
