#include "runtime/renderer.h"

#include <epoxy/gl.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <optional>

#include "cache/base/process.h"
#include "runtime/draw/frame_camera.h"
#include "runtime/draw/frame_painter.h"
#include "runtime/draw/frame_target.h"
#include "runtime/occlusion/occlusion.h"
#include "runtime/selection/hand_over.h"

namespace farcell {
namespace {

constexpr int kMultisamples = 4;

// Four moves of the picture, in pixels, that place the usual rotated grid of four samples so that all 16 lie in
// different columns and rows of a 16 x 16 grid.
constexpr std::array<std::array<double, 2>, 4> kJitterPx = {
    {{-1.5 / 16, 0.5 / 16}, {-0.5 / 16, -1.5 / 16}, {0.5 / 16, 1.5 / 16}, {1.5 / 16, -0.5 / 16}}};

constexpr int kPasses = kJitterPx.size();

int framesOf(const RenderSettings& settings) { return settings.samplesPerPixel == 16 ? kPasses : 1; }

glm::dvec2 jitterOf(int frame, int frames) {
  const auto& jitter = kJitterPx[static_cast<size_t>(frame)];
  return frames > 1 ? glm::dvec2(jitter[0], jitter[1]) : glm::dvec2(0);
}

// Where the samples of a pixel lie, y up.
std::vector<glm::vec2> samplePositions() {
  const FrameTarget target(1, 1, kMultisamples, false);
  target.begin();
  GLint count = 0;
  glGetIntegerv(GL_SAMPLES, &count);
  std::vector<glm::vec2> positions(static_cast<size_t>(std::max(count, 0)));
  for (size_t i = 0; i < positions.size(); ++i)
    glGetMultisamplefv(GL_SAMPLE_POSITION, static_cast<GLuint>(i), &positions[i].x);
  return positions;
}

class Stopwatch {
 public:
  double wallMs() const {
    return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start_).count();
  }
  double cpuMs() const { return (processCpuSeconds() - startCpuSeconds_) * 1e3; }

 private:
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
  double startCpuSeconds_ = processCpuSeconds();
};

SelectionSettings selectionOf(const RenderSettings& settings) {
  SelectionSettings selection = settings.selection;
  selection.costs = settings.costs.of(static_cast<size_t>(settings.kind), settings.samplesPerPixel);
  selection.timeBudgetMs /= framesOf(settings);
  return selection;
}

uint64_t countOf(const Cut& cut, Representation representation) {
  return static_cast<uint64_t>(std::count_if(cut.entries.begin(), cut.entries.end(), [&](const CutEntry& entry) {
    return entry.representation == representation;
  }));
}

void tell(const Cut& cut, const RenderSettings& settings, FrameStats& stats) {
  stats.triangles = cut.triangles;
  stats.meshes = countOf(cut, Representation::mesh);
  stats.work = cut.work;
  stats.expectedMs = framesOf(settings) * expectedMs(selectionOf(settings).costs, cut.work);
  stats.hiddenCells = cut.hidden.cells;
  stats.hiddenTriangles = static_cast<uint64_t>(cut.hidden.work.triangles);
  stats.hiddenBytes = cut.hidden.storedBytes;
  stats.hiddenMs = framesOf(settings) * expectedMs(selectionOf(settings).costs, cut.hidden.work);
  stats.expectedLoss = cut.loss;
  stats.lossBound = cut.lossBound;
}

void addTo(std::vector<uint16_t>& sums, const std::vector<uint8_t>& values) {
  sums.resize(values.size());
  for (size_t i = 0; i < values.size(); ++i) sums[i] = static_cast<uint16_t>(sums[i] + values[i]);
}

std::vector<uint8_t> meanOf(const std::vector<uint16_t>& sums, int count) {
  std::vector<uint8_t> result(sums.size());
  for (size_t i = 0; i < sums.size(); ++i) result[i] = static_cast<uint8_t>((sums[i] + count / 2) / count);
  return result;
}

// Pictures of one sample, and what is shown instead of the picture, are of one cut.
bool handsOver(const RenderSettings& settings) {
  const RenderMode mode = settings.selection.mode;
  const bool changes = mode != RenderMode::triangles && mode != RenderMode::full;
  return changes && settings.handOver && settings.samplesPerPixel > 1 && settings.show == Show::picture;
}

// What a window shows.
struct Shown {
  Camera camera;
  RenderSettings settings;
  Backdrop backdrop;
  bool operator==(const Shown&) const = default;
};

// Of a picture that is drawn in several.
struct Passes {
  int first, end, all;
};

}  // namespace

struct Renderer::Impl {
  explicit Impl(const PackFile& packFile) : pack(packFile), multisamples(samplePositions()), occluders(packFile) {}

  Result<> checkSettings(const RenderSettings& settings) const;
  const FrameTarget& targetFor(int width, int height, int samples, bool withCoverage);
  Result<Cut> cutOf(const Camera& camera, const RenderSettings& settings, glm::dvec2 jitterPx, FrameStats& stats);
  Result<> drawOnce(const Camera& camera, const RenderSettings& settings, const Cut& cut, bool withCoverage,
                    glm::dvec2 jitterPx, FrameStats& stats);
  Result<FrameStats> drawOver(const Shown& shown, Passes passes, GLuint framebuffer);
  Result<FrameStats> showNext(Shown next, GLuint framebuffer);

  const PackFile& pack;
  const std::vector<glm::vec2> multisamples;
  int maxSize = 0;
  OccluderCache occluders;
  OcclusionRest occlusionRest;
  std::optional<FramePainter> painter;
  std::optional<BackdropPainter> backdropPainter;  // made with the first picture that has a backdrop
  std::optional<FrameTarget> target;
  std::optional<Shown> shown;         // in the window
  int restingFrames = 0;              // that it has been the same
  std::optional<FrameTarget> gather;  // of passes while it is
};

Result<> Renderer::Impl::checkSettings(const RenderSettings& settings) const {
  if (settings.width < 1 || settings.height < 1 || settings.width > maxSize || settings.height > maxSize)
    return fail(ErrorKind::invalidArgument, "picture of {} x {}: each edge must lie in 1..{}", settings.width,
                settings.height, maxSize);
  if (settings.samplesPerPixel != 1 && settings.samplesPerPixel != 4 && settings.samplesPerPixel != 16)
    return fail(ErrorKind::invalidArgument, "samples per pixel: expected 1, 4 or 16, found {}",
                settings.samplesPerPixel);
  return checkLight(settings.light, pack.directory().model.settings, pack.path());
}

const FrameTarget& Renderer::Impl::targetFor(int width, int height, int samples, bool withCoverage) {
  if (!target || !target->matches(width, height, samples, withCoverage)) {
    target.reset();
    target.emplace(width, height, samples, withCoverage);
  }
  return *target;
}

Result<> Renderer::Impl::drawOnce(const Camera& camera, const RenderSettings& settings, const Cut& cut,
                                  bool withCoverage, glm::dvec2 jitterPx, FrameStats& stats) {
  const int samples = settings.samplesPerPixel > 1 ? kMultisamples : 1;
  const FrameTarget& frame = targetFor(settings.width, settings.height, samples, withCoverage);
  frame.begin();
  PaintCounts counts;
  const FrameCamera frameCamera = makeFrameCamera(
      pack.directory(), camera, {settings.width, settings.height, jitterPx, samples, settings.light}, cut);
  ShowPlan plan =
      planShow(settings.show, pack.directory(), cut, frameCamera, settings.kind, settings.selection.texelPixels);
  FARCELL_TRY(painter->paint(cut, frameCamera, settings.kind, plan, counts));
  frame.resolve();
  stats.impostors = counts.impostors;
  stats.texels = counts.texels;
  stats.bytesRead += counts.bytesRead;
  stats.legend = std::move(plan.legend);
  return {};
}

Result<Cut> Renderer::Impl::cutOf(const Camera& camera, const RenderSettings& settings, glm::dvec2 jitterPx,
                                  FrameStats& stats) {
  const SelectionSettings selection = selectionOf(settings);
  const Directory& directory = pack.directory();
  const auto selector = handsOver(settings) ? selectHandOver : selectCut;
  const auto select = [&](const HiddenCells* hidden) {
    return selector(directory, camera, settings.width, settings.height, selection, hidden);
  };
  Cut cut = select(nullptr);
  const bool known = settings.samplesPerPixel == 1 || multisamples.size() == kMultisamples;
  const bool wanted = settings.occlusion && selection.mode != RenderMode::full;
  // Flat impostors reach beyond the boxes of their cells.
  if (!wanted || !known || settings.kind == ImpostorKind::flat) return cut;
  if (settings.occlusionMustPay && occlusionRest.resting()) return cut;
  const Stopwatch watch;
  uint64_t read = 0;
  const std::vector<glm::vec2> samples =
      settings.samplesPerPixel == 1 ? std::vector<glm::vec2>{glm::vec2(0.5f)} : multisamples;
  FARCELL_ASSIGN(
      const Occlusion occlusion,
      Occlusion::of(directory, camera, {settings.width, settings.height, samples, jitterPx}, cut, occluders, read));
  Cut rest = select(&occlusion);
  const bool pays = !settings.occlusionMustPay ||
                    expectedMs(selection.costs, rest.hidden.work) > occlusion.expectedMs(cut.entries.size());
  occlusionRest.tried(pays);
  stats.occlusionMs += watch.wallMs();
  stats.occlusionBytes += read;
  stats.bytesRead += read;
  return pays ? rest : cut;
}

// Passes are averaged as they come: each is mixed with the mean of those before.
Result<FrameStats> Renderer::Impl::drawOver(const Shown& picture, Passes passes, GLuint framebuffer) {
  const auto& [camera, settings, backdrop] = picture;
  FARCELL_TRY(checkSettings(settings));
  if (!backdropPainter) {
    FARCELL_ASSIGN(BackdropPainter made, BackdropPainter::create());
    backdropPainter.emplace(std::move(made));
  }
  const Stopwatch watch;
  FrameStats stats;
  Cut cut;
  for (int i = passes.first; i < passes.end; ++i) {
    FARCELL_ASSIGN(cut, cutOf(camera, settings, jitterOf(i, passes.all), stats));
    FARCELL_TRY(drawOnce(camera, settings, cut, false, jitterOf(i, passes.all), stats));
    backdropPainter->paint(*target, backdrop, camera, upVector(pack.directory().model.settings.up), 1.0 / (i + 1),
                           framebuffer);
  }
  stats.wallMs = watch.wallMs();
  stats.cpuMs = watch.cpuMs();
  tell(cut, settings, stats);
  return stats;
}

// While the camera rests, the passes of 16 samples take the place of the 4 that a moving one is shown, one a frame.
Result<FrameStats> Renderer::Impl::showNext(Shown next, GLuint framebuffer) {
  const RenderSettings& settings = next.settings;
  FARCELL_TRY(checkSettings(settings));
  const bool same = shown == next, settled = same && restingFrames == kPasses;
  restingFrames = same ? std::min(restingFrames + 1, kPasses) : 0;
  shown = next;
  FrameStats stats;
  if (settings.samplesPerPixel != kMultisamples || restingFrames == 0) {
    FARCELL_ASSIGN(stats, drawOver(next, {0, framesOf(settings), framesOf(settings)}, framebuffer));
    stats.settled = settings.samplesPerPixel != kMultisamples;
    return stats;
  }
  if (!gather || !gather->matches(settings.width, settings.height, 1, false))
    gather.emplace(settings.width, settings.height, 1, false);
  FARCELL_ASSIGN(stats,
                 drawOver(next, {settled ? 0 : restingFrames - 1, restingFrames, kPasses}, gather->framebuffer()));
  glBlitNamedFramebuffer(gather->framebuffer(), framebuffer, 0, 0, settings.width, settings.height, 0, 0,
                         settings.width, settings.height, GL_COLOR_BUFFER_BIT, GL_NEAREST);
  stats.settled = restingFrames == kPasses;
  return stats;
}

Renderer::Renderer(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
Renderer::Renderer(Renderer&&) noexcept = default;
Renderer::~Renderer() = default;

Result<Renderer> Renderer::create(GlContext&, const PackFile& pack, uint64_t residentBytes) {
  auto impl = std::make_unique<Impl>(pack);
  GLint samples = 0;
  GLint textureSize = 0;
  std::array<GLint, 2> viewport{};
  glGetIntegerv(GL_MAX_SAMPLES, &samples);
  glGetIntegerv(GL_MAX_TEXTURE_SIZE, &textureSize);
  glGetIntegerv(GL_MAX_VIEWPORT_DIMS, viewport.data());
  if (samples < kMultisamples)
    return fail(ErrorKind::unsupported, "this OpenGL has {} samples per pixel, {} are needed", samples, kMultisamples);
  impl->maxSize = std::min({textureSize, viewport[0], viewport[1]});
  FARCELL_ASSIGN(FramePainter painter, FramePainter::create(pack, residentBytes));
  impl->painter.emplace(std::move(painter));
  return Renderer(std::move(impl));
}

Result<FrameStats> Renderer::draw(const Camera& camera, const RenderSettings& settings, FrameImage* image) {
  FARCELL_TRY(impl_->checkSettings(settings));
  FrameStats stats;
  std::vector<uint16_t> colourSums, coverageSums;
  const int frames = framesOf(settings);
  for (int i = 0; i < frames; ++i) {
    const Stopwatch watch;
    FARCELL_ASSIGN(const Cut cut, impl_->cutOf(camera, settings, jitterOf(i, frames), stats));
    FARCELL_TRY(impl_->drawOnce(camera, settings, cut, image != nullptr, jitterOf(i, frames), stats));
    glFinish();
    stats.wallMs += watch.wallMs();
    stats.cpuMs += watch.cpuMs();
    tell(cut, settings, stats);
    if (image == nullptr) continue;
    addTo(colourSums, impl_->target->readColour());
    addTo(coverageSums, impl_->target->readCoverage());
  }
  if (image != nullptr)
    *image = {settings.width, settings.height, meanOf(colourSums, frames), meanOf(coverageSums, frames)};
  return stats;
}

Result<FrameStats> Renderer::show(const Camera& camera, const RenderSettings& settings, const Backdrop& backdrop,
                                  uint32_t framebuffer) {
  return impl_->showNext({camera, settings, backdrop}, framebuffer);
}

Result<FrameImage> Renderer::capture(const Camera& camera, const RenderSettings& settings, const Backdrop& backdrop) {
  FARCELL_TRY(impl_->checkSettings(settings));
  const FrameTarget canvas(settings.width, settings.height, 1, false);
  const int frames = framesOf(settings);
  FARCELL_TRY(impl_->drawOver({camera, settings, backdrop}, {0, frames, frames}, canvas.framebuffer()));
  return FrameImage{settings.width, settings.height, canvas.readColour(), {}};
}

}  // namespace farcell
