#include "tools/options/draw_options.h"

#include <map>

#include "runtime/calibration/calibration.h"
#include "runtime/camera/overview.h"
#include "tools/cli/cli.h"

namespace farcell {
namespace {

const std::map<std::string, RenderMode> kModes = {{"auto", RenderMode::automatic},
                                                  {"impostors", RenderMode::impostors},
                                                  {"meshes", RenderMode::meshes},
                                                  {"triangles", RenderMode::triangles},
                                                  {"full", RenderMode::full}};
const std::map<std::string, ImpostorKind> kKinds = {
    {"flat", ImpostorKind::flat}, {"A", ImpostorKind::depthCorrected}, {"B", ImpostorKind::blended}};
const std::map<std::string, Show> kShows = {
    {"picture", Show::picture}, {"cells", Show::cells}, {"billboards", Show::billboards}, {"levels", Show::levels},
    {"kinds", Show::kinds},     {"error", Show::error}, {"depth", Show::depth},           {"normals", Show::normals}};

// Settings that go together. An option of its own has the last word.
struct Quality {
  double texelPixels, meshPixels;
  const char* samples;  // null: what the program has without the option
};
const std::map<std::string, Quality> kQualities = {{"default", {kTexelPixels, kMeshPixels, nullptr}},
                                                   {"high", {0.35, 0.5, "16"}}};

void addQuality(CLI::App& app, DrawOptions& options) {
  // Before the options it sets: values are taken in this order.
  app.add_option_function<std::string>(
         "--quality",
         [&options, ownSamples = options.samples](const std::string& name) {
           const Quality& quality = kQualities.at(name);
           options.texelPixels = quality.texelPixels;
           options.meshPixels = quality.meshPixels;
           options.samples = quality.samples != nullptr ? quality.samples : ownSamples;
         },
         "high: --texel-pixels 0.35 --mesh-pixels 0.5 --samples 16, unless given")
      ->check(CLI::IsMember(kQualities))
      ->default_str("default");
}

}  // namespace

int samplesNamed(const std::string& word) { return word == "auto" ? kSamplesAsNeeded : std::stoi(word); }
std::string samplesText(int samplesPerPixel) {
  return samplesPerPixel == kSamplesAsNeeded ? "auto" : std::to_string(samplesPerPixel);
}

void addDrawOptions(CLI::App& app, DrawOptions& options, const std::string& background) {
  app.add_option("pack", options.pack, "pack file (.far)")->required();
  app.add_option("--camera", options.cameras, "camera file (JSON); without it: an overview of the model");
  app.add_option("--camera-name", options.cameraName, "which camera of the file; default: the first")
      ->type_name("NAME");
  app.add_option("--size", options.size, "width x height in pixels, 1x1 to 16384x16384")
      ->type_name("WxH")
      ->capture_default_str();
  app.add_option("--mode", options.mode,
                 "what is drawn; meshes: no impostors, triangles: all leaves in view, full: all leaves")
      ->check(CLI::IsMember(kModes))
      ->capture_default_str();
  app.add_option("--kind", options.kind, "of impostors: A corrects one view by its depth, B blends three")
      ->check(CLI::IsMember(kKinds))
      ->capture_default_str();
  app.add_option("--show", options.show,
                 "the picture, or over it: edges of cells, outlines of billboards; or instead: octree levels, kinds of "
                 "drawing, expected error (texels on screen, pixels), depth, normals")
      ->check(CLI::IsMember(kShows))
      ->capture_default_str();
  app.add_option("--triangle-budget", options.triangleBudget, "most triangles of a frame in mode auto, e.g. 500k")
      ->type_name("COUNT")
      ->capture_default_str();
  addQuality(app, options);
  app.add_option("--time-budget-ms", options.timeBudgetMs,
                 "the least error in a frame of so many milliseconds, by what drawing was measured to cost on this "
                 "machine at the first such start; 0: no such budget")
      ->type_name("MS")
      ->check(CLI::Range(0.0, 1e6))
      ->capture_default_str();
  app.add_flag("--recalibrate", options.recalibrate, "measure again what drawing costs on this machine");
  app.add_option("--occlusion", options.occlusion, "leave out what nearer triangles hide; on is an experiment")
      ->check(CLI::IsMember({"on", "off"}))
      ->capture_default_str();
  app.add_option("--texel-pixels", options.texelPixels,
                 "an impostor's texel may be this large on screen, pixels; smaller: less error, more cells")
      ->check(CLI::Range(0.01, 100.0))
      ->capture_default_str();
  app.add_option("--mesh-pixels", options.meshPixels,
                 "a simplified mesh may be this far from the full surface on screen, pixels; 0: none is drawn")
      ->check(CLI::Range(0.0, 100.0))
      ->capture_default_str();
  app.add_option("--samples", options.samples,
                 "samples per pixel; auto: 8 where triangles fill a fifth of the picture, else 4; with 4 or more cells "
                 "change how they are drawn without a pop")
      ->check(CLI::IsMember(kSampleWords))
      ->capture_default_str();
  addLightOptions(app, options.light);
  app.add_option("--background", options.background, "colour behind the model, 0 to 255 each; default: " + background)
      ->type_name("R,G,B");
  app.add_option("--resident-bytes", options.residentBytes, "how many bytes of the pack are kept on the GPU, e.g. 500M")
      ->type_name("COUNT")
      ->capture_default_str();
}

Result<DrawPlan> planOf(const DrawOptions& options) {
  DrawPlan plan;
  FARCELL_ASSIGN(const ImageSize size, parseImageSize(options.size));
  plan.settings.selection.mode = kModes.at(options.mode);
  plan.settings.kind = kKinds.at(options.kind);
  plan.settings.show = kShows.at(options.show);
  FARCELL_ASSIGN(plan.settings.selection.triangleBudget, parseCount(options.triangleBudget));
  plan.settings.selection.timeBudgetMs = options.timeBudgetMs;
  plan.recalibrate = options.recalibrate;
  plan.settings.occlusion = options.occlusion == "on";
  plan.settings.selection.texelPixels = options.texelPixels;
  plan.settings.selection.meshPixels = options.meshPixels;
  FARCELL_ASSIGN(plan.residentBytes, parseCount(options.residentBytes));
  if (options.cameras.empty() && !options.cameraName.empty())
    return fail(ErrorKind::invalidArgument, "--camera-name needs --camera");
  plan.settings.width = size.width;
  plan.settings.height = size.height;
  plan.settings.samplesPerPixel = samplesNamed(options.samples);
  FARCELL_ASSIGN(plan.settings.light, lightOf(options.light));
  if (!options.background.empty()) {
    FARCELL_ASSIGN(plan.background, parseColour("--background", options.background));
  }
  return plan;
}

Result<> applyMachineCosts(GlContext& context, bool recalibrate, RenderSettings& settings) {
  if (settings.selection.timeBudgetMs == 0 && !recalibrate) return {};
  FARCELL_ASSIGN(settings.costs, machineCosts(context, recalibrate));
  return {};
}

Result<Camera> chooseCamera(const DrawOptions& options, const Model& model, int width, int height) {
  if (options.cameras.empty()) {
    const glm::dvec3 min = model.grid.worldFromGrid(model.bounds.min);
    const glm::dvec3 max = model.grid.worldFromGrid(model.bounds.max);
    return overviewCamera(min, max, upVector(model.settings.up), static_cast<double>(width) / height);
  }
  FARCELL_ASSIGN(const std::vector<Camera> cameras, readCameras(options.cameras));
  if (options.cameraName.empty()) return cameras.front();
  for (const Camera& camera : cameras)
    if (camera.name == options.cameraName) return camera;
  return fail(ErrorKind::invalidArgument, "{}: no camera is named '{}'", options.cameras, options.cameraName);
}

const char* modeName(RenderMode mode) {
  for (const auto& [name, value] : kModes)
    if (value == mode) return name.c_str();
  return "";
}

const char* kindName(ImpostorKind kind) {
  for (const auto& [name, value] : kKinds)
    if (value == kind) return name.c_str();
  return "";
}

const char* showName(Show show) {
  for (const auto& [name, value] : kShows)
    if (value == show) return name.c_str();
  return "";
}

}  // namespace farcell
