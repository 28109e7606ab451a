#include "tools/view/viewer.h"

#include <fmt/chrono.h>

#include <algorithm>
#include <cstdio>
#include <ctime>
#include <numbers>

#include "cache/base/file.h"
#include "cache/base/interrupt.h"
#include "tools/image/png.h"
#include "tools/view/frame_figures.h"

namespace farcell {
namespace {

using Clock = std::chrono::steady_clock;

constexpr std::chrono::milliseconds kIdle{250};  // how often a window that nothing happens to asks for Ctrl-C
constexpr std::chrono::milliseconds kTitlePeriod{250};
constexpr double kFirstStepSeconds = 1.0 / 60;  // of the frame after a rest: time that passed before is not motion
constexpr double kLongestStepSeconds = 0.1;     // a frame that took longer moves as if it had not

double millisecondsSince(Clock::time_point start) {
  return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
}

RenderMode nextMode(RenderMode mode) {
  if (mode == RenderMode::automatic) return RenderMode::impostors;
  return mode == RenderMode::impostors ? RenderMode::full : RenderMode::automatic;
}

ImpostorKind nextKind(ImpostorKind kind) {
  if (kind == ImpostorKind::flat) return ImpostorKind::depthCorrected;
  return kind == ImpostorKind::depthCorrected ? ImpostorKind::blended : ImpostorKind::flat;
}

Result<> writePicture(const std::filesystem::path& path, const FrameImage& image) {
  Picture picture{image.width, image.height, 3, {}};
  for (size_t i = 0; i < image.rgba.size(); i += 4)
    picture.pixels.insert(picture.pixels.end(), {image.rgba[i], image.rgba[i + 1], image.rgba[i + 2]});
  return writePng(path, picture);
}

// "farcell-linz-20260131-235959-123": names sort by time.
std::string captureName(const PackFile& pack) {
  const auto now = std::chrono::system_clock::now();
  const auto sinceEpoch = std::chrono::duration_cast<std::chrono::milliseconds>(now.time_since_epoch());
  return fmt::format("farcell-{}-{:%Y%m%d-%H%M%S}-{:03}", std::filesystem::path(pack.path()).stem().string(),
                     fmt::localtime(std::chrono::system_clock::to_time_t(now)), sinceEpoch.count() % 1000);
}

constexpr double kSunStepRad = std::numbers::pi / 36;

// Around the model and upwards, radians.
glm::dvec2 sunStepOf(Command command) {
  if (command == Command::sunLeft) return {-kSunStepRad, 0};
  if (command == Command::sunRight) return {kSunStepRad, 0};
  if (command == Command::sunHigher) return {0, kSunStepRad};
  if (command == Command::sunLower) return {0, -kSunStepRad};
  return glm::dvec2(0);
}

// The sun stands where it stood.
Light nextLight(Light light) {
  light.kind = light.kind == LightKind::sun ? LightKind::headlight : LightKind::sun;
  return light;
}

Backdrop backdropOf(const DrawPlan& plan) {
  return plan.background ? Backdrop{*plan.background, *plan.background, *plan.background} : kSky;
}

}  // namespace

Result<Viewer> Viewer::open(const ViewOptions& options, const DrawPlan& plan) {
  FARCELL_ASSIGN(PackFile pack, PackFile::open(options.pack));
  FARCELL_TRY(checkLight(plan.settings.light, pack.directory().model.settings, pack.path()));
  FARCELL_ASSIGN(const Camera camera,
                 chooseCamera(options, pack.directory().model, plan.settings.width, plan.settings.height));
  FARCELL_ASSIGN(Window window, Window::open({.title = "farcell",
                                              .width = plan.settings.width,
                                              .height = plan.settings.height,
                                              .waitForScreen = options.frames == 0}));
  DrawPlan calibrated = plan;
  FARCELL_TRY(applyMachineCosts(window.context(), plan.recalibrate, calibrated.settings));
  FARCELL_ASSIGN(Scene scene, openScene(std::move(pack), camera, window.context(), plan.residentBytes));
  return Viewer(options, calibrated, std::move(window), std::move(scene));
}

Viewer::Viewer(const ViewOptions& options, const DrawPlan& plan, Window window, Scene scene)
    : options_(options),
      settings_(plan.settings),
      backdrop_(backdropOf(plan)),
      residentBytes_(plan.residentBytes),
      window_(std::move(window)),
      scene_(std::move(scene)) {
  fitSize();
}

Result<Viewer::Scene> Viewer::openScene(PackFile pack, const Camera& camera, GlContext& context,
                                        uint64_t residentBytes) {
  Scene scene;
  scene.pack = std::make_unique<PackFile>(std::move(pack));
  FARCELL_ASSIGN(Renderer renderer, Renderer::create(context, *scene.pack, residentBytes));
  scene.renderer = std::make_unique<Renderer>(std::move(renderer));
  scene.controls = std::make_unique<Controls>(scene.pack->directory(), camera);
  return scene;
}

Result<> Viewer::run() {
  Clock::time_point last = Clock::now();
  while (!quit_ && !window_.closeAsked()) {
    FARCELL_TRY(checkInterrupt());
    const bool idle = !visible() || (!stale_ && !scene_.controls->moving());
    for (const Event& event : idle ? window_.wait(kIdle) : window_.poll()) handle(event);
    const Clock::time_point now = Clock::now();
    const double passed = std::chrono::duration<double>(now - last).count();
    last = now;
    stale_ |= scene_.controls->advance(idle ? kFirstStepSeconds : std::min(passed, kLongestStepSeconds));
    if (stale_ && visible()) drawNow();
    if (frameCount_ > 0 && !scene_.controls->moving()) updateTitle(true);
  }
  return {};
}

Result<> Viewer::measure() {
  FrameFigures figures{window_.context().renderer(), {settings_.width, settings_.height}, {}, {}};
  const CameraPose start = poseOf(scene_.controls->camera());
  for (int i = 0; i < options_.frames && !window_.closeAsked(); ++i) {
    FARCELL_TRY(checkInterrupt());
    window_.poll();
    FrameStats stats;
    const double yawRad = 2 * std::numbers::pi * i / options_.frames;
    FARCELL_ASSIGN(const double frameMs, drawFrame(cameraOf(orbited(start, yawRad, 0)), stats));
    figures.frameMs.push_back(frameMs);
    figures.stats.push_back(stats);
  }
  if (figures.frameMs.empty()) return fail(ErrorKind::cancelled, "closed before the first frame");
  std::fprintf(stderr, "%zu frames of %d x %d: median %.1f ms, p95 %.1f, max %.1f, first %.1f (%s)\n",
               figures.frameMs.size(), figures.sizePx.x, figures.sizePx.y, figures.medianMs(), figures.p95Ms(),
               figures.maxMs(), figures.frameMs[0], figures.openGl.c_str());
  if (options_.statsFile.empty()) return {};
  return writeFigures(options_.statsFile, figures);
}

Result<> Viewer::captureTo(const std::string& path) {
  FARCELL_ASSIGN(const FrameImage image, scene_.renderer->capture(scene_.controls->camera(), settings_, backdrop_));
  return writePicture(path, image);
}

void Viewer::handle(const Event& event) {
  scene_.controls->handle(event);
  window_.holdPointer(scene_.controls->wantsPointer());
  if (event.kind == EventKind::exposed) {
    fitSize();
    stale_ = true;
  } else if (event.kind == EventKind::dropped) {
    openDropped(event.path);
  } else if (event.kind == EventKind::keyDown) {
    problem_.clear();
    if (const auto command = commandOf(event.key)) obey(*command);
  }
}

void Viewer::obey(Command command) {
  scene_.controls->obey(command);
  if (command == Command::quit) quit_ = true;
  if (command == Command::nextMode) settings_.selection.mode = nextMode(settings_.selection.mode);
  if (command == Command::nextKind) settings_.kind = nextKind(settings_.kind);
  if (command == Command::nextLight) setLight(nextLight(settings_.light));
  if (const glm::dvec2 step = sunStepOf(command); step != glm::dvec2(0))
    setLight(movedSun(settings_.light, scene_.pack->directory().model.settings, step.x, step.y));
  if (command == Command::capture) saveCapture();
  if (command == Command::help) std::fputs(keyHelp().c_str(), stdout);
  std::fflush(stdout);
  stale_ |= command == Command::nextMode || command == Command::nextKind;
  updateTitle(true);
}

// The picture that is there stays where the file is none.
void Viewer::openDropped(const std::filesystem::path& path) {
  auto pack = PackFile::open(path);
  if (!pack) return report(pack.error().message);
  DrawOptions overview;
  const auto camera = chooseCamera(overview, pack->directory().model, settings_.width, settings_.height);
  if (!camera) return report(camera.error().message);
  auto scene = openScene(std::move(*pack), *camera, window_.context(), residentBytes_);
  if (!scene) return report(scene.error().message);
  std::swap(scene_, *scene);
  if (!checkLight(settings_.light, scene_.pack->directory().model.settings, path)) settings_.light = {};
  options_.pack = path;
  problem_.clear();
  fitSize();
  stale_ = true;
}

// A pack of baked light keeps its sun, and says so.
void Viewer::setLight(const Light& light) {
  const auto possible = checkLight(light, scene_.pack->directory().model.settings, scene_.pack->path());
  if (!possible) return report(possible.error().message);
  settings_.light = light;
  stale_ = true;
}

void Viewer::saveCapture() {
  const std::string name = captureName(*scene_.pack);
  Camera camera = scene_.controls->camera();
  camera.name = name;
  const auto image = scene_.renderer->capture(camera, settings_, backdrop_);
  if (!image) return report(image.error().message);
  if (const auto written = writePicture(name + ".png", *image); !written) return report(written.error().message);
  if (const auto written = writeTextFile(name + ".json", camerasJson({camera})); !written)
    return report(written.error().message);
  std::printf("%s.png; again: %s -o again.png\n", name.c_str(),
              renderCommand(options_, settings_, options_.pack, name + ".json").c_str());
}

bool Viewer::visible() const {
  const glm::ivec2 size = window_.sizePx();
  return size.x > 0 && size.y > 0;
}

void Viewer::fitSize() {
  if (!visible()) return;
  const glm::ivec2 size = window_.sizePx();
  settings_.width = size.x;
  settings_.height = size.y;
  scene_.controls->setSize(size);
}

Result<double> Viewer::drawFrame(const Camera& camera, FrameStats& stats) {
  const Clock::time_point start = Clock::now();
  FARCELL_ASSIGN(stats, scene_.renderer->show(camera, settings_, backdrop_));
  window_.show();
  return millisecondsSince(start);
}

void Viewer::drawNow() {
  stale_ = false;
  const auto frameMs = drawFrame(scene_.controls->camera(), lastStats_);
  if (!frameMs) return report(frameMs.error().message);
  stale_ = !lastStats_.settled;
  sumMs_ += *frameMs;
  ++frameCount_;
  updateTitle(false);
}

// Once: a page that cannot be read would be told with every frame.
void Viewer::report(const std::string& problem) {
  if (problem == problem_) return;
  problem_ = problem;
  std::fprintf(stderr, "farcell-view: %s\n", problem.c_str());
  updateTitle(true);
}

void Viewer::updateTitle(bool now) {
  if (!now && Clock::now() - titleSet_ < kTitlePeriod) return;
  titleSet_ = Clock::now();
  if (frameCount_ > 0) meanMs_ = sumMs_ / frameCount_;
  sumMs_ = 0;
  frameCount_ = 0;
  std::string title = std::filesystem::path(scene_.pack->path()).filename().string();
  if (!problem_.empty()) title += " | " + problem_;
  title +=
      fmt::format(" | {}, {}, {} | {:.1f} ms, {:.0f} fps | {} triangles, {} meshes, {} impostors",
                  scene_.controls->navigation() == Navigation::orbit ? "orbit" : "fly",
                  modeName(settings_.selection.mode), kindName(settings_.kind), meanMs_,
                  meanMs_ > 0 ? 1000 / meanMs_ : 0.0, lastStats_.triangles, lastStats_.meshes, lastStats_.impostors);
  window_.setTitle(title);
}

}  // namespace farcell
