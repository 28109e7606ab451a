#include "runtime/renderer.h"

#include <epoxy/gl.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <optional>

#include "cache/base/process.h"
#include "runtime/draw/frame_camera.h"
#include "runtime/draw/frame_painter.h"
#include "runtime/draw/frame_target.h"
#include "runtime/draw/sample_mean.h"
#include "runtime/occlusion/occlusion.h"
#include "runtime/selection/hand_over.h"

namespace farcell {
namespace {

constexpr double kTriangleShare = 0.2;  // of what is drawn, from which on more samples pay
constexpr int kPassesOfTriangles = 2;

// Of a moving camera's picture; where they are as needed, the fewest and the most.
int passesOf(const RenderSettings& settings) { return std::max(settings.samplesPerPixel / kMultisamples, 1); }
int mostPassesOf(const RenderSettings& settings) {
  return settings.samplesPerPixel == kSamplesAsNeeded ? kPassesOfTriangles : passesOf(settings);
}

// Evenly spread, by the golden ratio.
double ditherOf(int pass) { return std::fmod(pass * 0.6180339887498949, 1.0); }

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
  selection.costs = settings.costs.of(static_cast<size_t>(settings.kind), settings.samplesPerPixel != 1);
  selection.timeBudgetMs /= passesOf(settings);
  return selection;
}

uint64_t countOf(const Cut& cut, Representation representation) {
  return static_cast<uint64_t>(std::count_if(cut.entries.begin(), cut.entries.end(), [&](const CutEntry& entry) {
    return entry.representation == representation;
  }));
}

// That are needed of a cut.
int passesFor(const Cut& cut, const RenderSettings& settings) {
  if (settings.samplesPerPixel != kSamplesAsNeeded) return passesOf(settings);
  const double budget = settings.selection.timeBudgetMs;
  const bool fits = budget == 0 || kPassesOfTriangles * expectedMs(selectionOf(settings).costs, cut.work) <= budget;
  const bool pays = cut.work.meshPixels > kTriangleShare * (cut.work.meshPixels + cut.work.impostorPixels);
  return fits && pays ? kPassesOfTriangles : 1;
}

void tell(const Cut& cut, const RenderSettings& settings, int passes, FrameStats& stats) {
  stats.samples = passes * (settings.samplesPerPixel == 1 ? 1 : kMultisamples);
  stats.triangles = cut.triangles;
  stats.meshes = countOf(cut, Representation::mesh);
  stats.work = cut.work;
  stats.expectedMs = passes * expectedMs(selectionOf(settings).costs, cut.work);
  stats.hiddenCells = cut.hidden.cells;
  stats.hiddenTriangles = static_cast<uint64_t>(cut.hidden.work.triangles);
  stats.hiddenBytes = cut.hidden.storedBytes;
  stats.hiddenMs = passes * expectedMs(selectionOf(settings).costs, cut.hidden.work);
  stats.expectedLoss = cut.loss;
  stats.lossBound = cut.lossBound;
}

// Pictures of one sample, and what is shown instead of the picture, are of one cut.
bool handsOver(const RenderSettings& settings) {
  const RenderMode mode = settings.selection.mode;
  const bool changes = mode != RenderMode::triangles && mode != RenderMode::full;
  return changes && settings.handOver && settings.samplesPerPixel != 1 && settings.show == Show::picture;
}

// What a window shows.
struct Shown {
  Camera camera;
  RenderSettings settings;
  Backdrop backdrop;
  bool operator==(const Shown&) const = default;
};

// Some of the passes of a picture that is to have so many in all: from first to before end.
struct Passes {
  int first, end, all;
  int size() const { return end - first; }
};

// A cell is hidden where it is in all passes.
struct HiddenInPasses : HiddenCells {
  std::vector<Occlusion> passes;
  bool hides(uint32_t cell) const override {
    return std::all_of(passes.begin(), passes.end(), [&](const Occlusion& pass) { return pass.hides(cell); });
  }
  bool needs(uint32_t cell) const override {
    return std::any_of(passes.begin(), passes.end(), [&](const Occlusion& pass) { return pass.needs(cell); });
  }
  double expectedMs(size_t cells) const {
    double sum = 0;
    for (const Occlusion& pass : passes) sum += pass.expectedMs(cells);
    return sum;
  }
};

}  // namespace

struct Renderer::Impl {
  explicit Impl(const PackFile& packFile) : pack(packFile), multisamples(samplePositions()), occluders(packFile) {}

  Result<> checkSettings(const RenderSettings& settings) const;
  const FrameTarget& targetFor(int width, int height, int samples, bool withCoverage);
  Result<SampleMean*> meanFor(const RenderSettings& settings, bool withCoverage);
  Result<Cut> cutOf(const Camera& camera, const RenderSettings& settings, Passes passes, FrameStats& stats);
  Result<> drawOnce(const Camera& camera, const RenderSettings& settings, const Cut& cut, bool withCoverage,
                    Passes pass, FrameStats& stats);
  Result<> gather(const Camera& camera, const RenderSettings& settings, const Cut& cut, bool withCoverage,
                  Passes passes, FrameStats& stats);
  Result<> drawWhole(const Camera& camera, const RenderSettings& settings, bool withCoverage, FrameStats& stats);
  bool isGathered(const FrameStats& stats) const { return stats.samples > kMultisamples; }  // else in `target`
  GLuint wholeColour(const FrameStats& stats) const { return isGathered(stats) ? mean->colour() : target->colour(); }
  Result<> paintOver(const Shown& picture, GLuint colour, GLuint framebuffer);
  Result<FrameStats> showNext(const Shown& next, GLuint framebuffer);

  const PackFile& pack;
  const std::vector<glm::vec2> multisamples;
  int maxSize = 0;
  OccluderCache occluders;
  OcclusionRest occlusionRest;
  std::optional<FramePainter> painter;
  std::optional<BackdropPainter> backdropPainter;  // made with the first picture that has a backdrop
  std::optional<FrameTarget> target;
  std::optional<SampleMean> mean;  // of the passes of a picture
  std::optional<Shown> shown;      // in the window; `mean` has passes of it, or none
  FrameStats shownStats;
};

Result<> Renderer::Impl::checkSettings(const RenderSettings& settings) const {
  if (settings.width < 1 || settings.height < 1 || settings.width > maxSize || settings.height > maxSize)
    return fail(ErrorKind::invalidArgument, "picture of {} x {}: each edge must lie in 1..{}", settings.width,
                settings.height, maxSize);
  constexpr std::array kSamples = {kSamplesAsNeeded, 1, 4, 8, 16, 64};
  if (std::find(kSamples.begin(), kSamples.end(), settings.samplesPerPixel) == kSamples.end())
    return fail(ErrorKind::invalidArgument, "samples per pixel: expected {}, found {}", fmt::join(kSamples, ", "),
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

Result<SampleMean*> Renderer::Impl::meanFor(const RenderSettings& settings, bool withCoverage) {
  if (!mean || !mean->matches(settings.width, settings.height, withCoverage)) {
    mean.reset();
    FARCELL_ASSIGN(mean, SampleMean::create(settings.width, settings.height, withCoverage, multisamples));
  }
  return &*mean;
}

Result<> Renderer::Impl::drawOnce(const Camera& camera, const RenderSettings& settings, const Cut& cut,
                                  bool withCoverage, Passes pass, FrameStats& stats) {
  const int samples = settings.samplesPerPixel == 1 ? 1 : kMultisamples;
  const FrameTarget& frame = targetFor(settings.width, settings.height, samples, withCoverage);
  frame.begin();
  PaintCounts counts;
  const FrameCamera frameCamera = makeFrameCamera(pack.directory(), camera,
                                                  {settings.width, settings.height, -sampleMove(pass.first),
                                                   samples * pass.all, settings.light, ditherOf(pass.first)},
                                                  cut);
  ShowPlan plan =
      planShow(settings.show, pack.directory(), cut, frameCamera, settings.kind, settings.selection.texelPixels);
  FARCELL_TRY(painter->paint(cut, frameCamera, settings.kind, plan, counts));
  stats.impostors = counts.impostors;
  stats.texels = counts.texels;
  stats.bytesRead += counts.bytesRead;
  stats.legend = std::move(plan.legend);
  return {};
}

Result<Cut> Renderer::Impl::cutOf(const Camera& camera, const RenderSettings& settings, Passes passes,
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
  HiddenInPasses hidden;
  for (int pass = passes.first; pass < passes.end; ++pass) {
    FARCELL_ASSIGN(Occlusion occlusion,
                   Occlusion::of(directory, camera, {settings.width, settings.height, samples, -sampleMove(pass)}, cut,
                                 occluders, read));
    hidden.passes.push_back(std::move(occlusion));
  }
  Cut rest = select(&hidden);
  const bool pays = !settings.occlusionMustPay || passes.size() * expectedMs(selection.costs, rest.hidden.work) >
                                                      hidden.expectedMs(cut.entries.size());
  occlusionRest.tried(pays);
  stats.occlusionMs += watch.wallMs();
  stats.occlusionBytes += read;
  stats.bytesRead += read;
  return pays ? rest : cut;
}

// Adds passes of one cut to the mean.
Result<> Renderer::Impl::gather(const Camera& camera, const RenderSettings& settings, const Cut& cut, bool withCoverage,
                                Passes passes, FrameStats& stats) {
  FARCELL_ASSIGN(SampleMean * sum, meanFor(settings, withCoverage));
  if (passes.first == 0) sum->clear();
  for (int pass = passes.first; pass < passes.end; ++pass) {
    FARCELL_TRY(drawOnce(camera, settings, cut, withCoverage, {pass, pass + 1, passes.all}, stats));
    sum->add(*target);
  }
  tell(cut, settings, passes.size(), stats);
  return {};
}

// A single pass needs no mean.
Result<> Renderer::Impl::drawWhole(const Camera& camera, const RenderSettings& settings, bool withCoverage,
                                   FrameStats& stats) {
  const int most = mostPassesOf(settings);
  FARCELL_ASSIGN(const Cut cut, cutOf(camera, settings, {0, most, most}, stats));
  const int passes = passesFor(cut, settings);
  if (passes > 1) return gather(camera, settings, cut, withCoverage, {0, passes, passes}, stats);
  FARCELL_TRY(drawOnce(camera, settings, cut, withCoverage, {0, 1, 1}, stats));
  target->resolve();
  tell(cut, settings, 1, stats);
  return {};
}

Result<> Renderer::Impl::paintOver(const Shown& picture, GLuint colour, GLuint framebuffer) {
  if (!backdropPainter) {
    FARCELL_ASSIGN(BackdropPainter made, BackdropPainter::create());
    backdropPainter.emplace(std::move(made));
  }
  backdropPainter->paint(colour, {picture.settings.width, picture.settings.height}, picture.backdrop, picture.camera,
                         upVector(pack.directory().model.settings.up), framebuffer);
  return {};
}

// While the camera rests, passes are added to what a moving one is shown, one a frame (the first two at once: one alone
// was shown already); then nothing is drawn any more.
Result<FrameStats> Renderer::Impl::showNext(const Shown& next, GLuint framebuffer) {
  const RenderSettings& settings = next.settings;
  FARCELL_TRY(checkSettings(settings));
  const Stopwatch watch;
  const bool gathers = settings.samplesPerPixel != 1, same = shown == next && gathers;
  shown.reset();
  FrameStats stats;
  GLuint colour = 0;
  if (!same) {
    if (mean) mean->clear();
    FARCELL_TRY(drawWhole(next.camera, settings, false, stats));
    colour = wholeColour(stats);
  } else {
    const int passes = mean ? mean->passes() : 0;
    if (passes == kMostPasses) {
      stats = shownStats;
    } else {
      const Passes more{passes, std::max(passes + 1, 2), kMostPasses};
      FARCELL_ASSIGN(const Cut cut, cutOf(next.camera, settings, more, stats));
      FARCELL_TRY(gather(next.camera, settings, cut, false, more, stats));
    }
    colour = mean->colour();
  }
  FARCELL_TRY(paintOver(next, colour, framebuffer));
  stats.wallMs = watch.wallMs();
  stats.cpuMs = watch.cpuMs();
  stats.settled = !gathers || (mean && mean->passes() == kMostPasses);
  shown = next;
  shownStats = stats;
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
  impl_->shown.reset();
  const Stopwatch watch;
  FrameStats stats;
  FARCELL_TRY(impl_->drawWhole(camera, settings, image != nullptr, stats));
  glFinish();
  stats.wallMs = watch.wallMs();
  stats.cpuMs = watch.cpuMs();
  if (image == nullptr) return stats;
  if (impl_->isGathered(stats)) {
    *image = {settings.width, settings.height, impl_->mean->readColour(), impl_->mean->readCoverage()};
  } else {
    *image = {settings.width, settings.height, impl_->target->readColour(), impl_->target->readCoverage()};
  }
  return stats;
}

Result<FrameStats> Renderer::show(const Camera& camera, const RenderSettings& settings, const Backdrop& backdrop,
                                  uint32_t framebuffer) {
  return impl_->showNext({camera, settings, backdrop}, framebuffer);
}

Result<FrameImage> Renderer::capture(const Camera& camera, const RenderSettings& settings, const Backdrop& backdrop) {
  FARCELL_TRY(impl_->checkSettings(settings));
  const FrameTarget canvas(settings.width, settings.height, 1, false);
  const Shown picture{camera, settings, backdrop};
  impl_->shown.reset();
  FrameStats stats;
  FARCELL_TRY(impl_->drawWhole(camera, settings, false, stats));
  FARCELL_TRY(impl_->paintOver(picture, impl_->wholeColour(stats), canvas.framebuffer()));
  return FrameImage{settings.width, settings.height, canvas.readColour(), {}};
}

}  // namespace farcell
