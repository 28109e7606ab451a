#include "tests/bench/wscg2010/measure/experiment.h"

#include <chrono>
#include <cstdio>

#include "cache/base/process.h"
#include "runtime/gl/context.h"

namespace farcell::wscg {
namespace {

Result<> makeDirectory(const std::filesystem::path& path) {
  std::error_code error;
  std::filesystem::create_directories(path, error);
  if (error) return fail(ErrorKind::io, "{}: {}", path.string(), error.message());
  return {};
}

class Talk {
 public:
  explicit Talk(std::string scene) : scene_(std::move(scene)) {}
  void say(const char* what) {
    const auto now = std::chrono::steady_clock::now();
    std::fprintf(stderr, "%s: %s (%.1f s, %.0f MB peak)\n", scene_.c_str(), what,
                 std::chrono::duration<double>(now - last_).count(), static_cast<double>(peakRssBytes()) / 1e6);
    last_ = now;
  }

 private:
  std::string scene_;
  std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
};

// Growth changes what a cell's images weigh.
Result<> sizesOf(const CellIndex& index, const ExperimentSettings& settings, ExperimentResults& results) {
  for (const Content content : {Content::sphere, Content::cube, Content::grown}) {
    Variant variant = paperVariant(settings.depth);
    variant.impostors.content = content;
    variant.name += content == Content::cube ? ", cut to the cube" : content == Content::grown ? ", grown 1.04" : "";
    FARCELL_ASSIGN(SizeResult sizes, measureSizes(index, variant, settings.sizes));
    results.sizes.push_back(std::move(sizes));
  }
  return {};
}

Result<> runScene(const std::filesystem::path& model, const ExperimentSettings& settings, ExperimentResults& results) {
  FARCELL_ASSIGN(const Scene scene, loadScene(model, settings.up));
  Talk talk(scene.name);
  results.scenes.push_back({scene.name, scene.triangles.size()});
  FARCELL_ASSIGN(const FullGeometry full, FullGeometry::create(scene));
  talk.say("triangles ready");
  FARCELL_ASSIGN(const ErrorResults errors, measureErrors(scene, full, settings.errors));
  results.errors.rows.insert(results.errors.rows.end(), errors.rows.begin(), errors.rows.end());
  results.errors.cells.insert(results.errors.cells.end(), errors.cells.begin(), errors.cells.end());
  talk.say("errors measured");
  const CellIndex index(scene, settings.depth);
  TimeSettings timing = settings.times;
  timing.scratchDirectory = settings.output;
  FARCELL_ASSIGN(const std::vector<TimeRow> times, measureTimes(index, full, paperVariant(settings.depth), timing));
  results.times.insert(results.times.end(), times.begin(), times.end());
  talk.say("frames timed");
  FARCELL_TRY(sizesOf(index, settings, results));
  talk.say("images coded");
  const std::filesystem::path pictures = settings.output / scene.name;
  FARCELL_TRY(makeDirectory(pictures));
  FARCELL_ASSIGN(NearTriangles near, drawPictures(index, full, pictures));
  results.near.push_back(std::move(near));
  talk.say("pictures drawn");
  return {};
}

}  // namespace

ExperimentSettings quickSettings() {
  ExperimentSettings settings;
  settings.errors = {320, 240, 16, {.5, 2}, 1};
  settings.times.width = 320;
  settings.times.height = 240;
  settings.times.frames = 4;
  settings.sizes.cells = 2;
  return settings;
}

Result<ExperimentResults> runExperiment(const ExperimentSettings& settings) {
  FARCELL_TRY(makeDirectory(settings.output));
  FARCELL_ASSIGN(const GlContext context, GlContext::createHeadless());
  ExperimentResults results;
  results.renderer = context.renderer();
  for (const std::filesystem::path& model : settings.models) FARCELL_TRY(runScene(model, settings, results));
  return results;
}

}  // namespace farcell::wscg
