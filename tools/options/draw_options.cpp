#include "tools/options/draw_options.h"

#include <utility>

#include "runtime/camera/overview.h"
#include "tools/cli/cli.h"

namespace farcell {
namespace {

constexpr std::array<std::pair<const char*, RenderMode>, 4> kModes = {{{"auto", RenderMode::automatic},
                                                                       {"impostors", RenderMode::impostors},
                                                                       {"triangles", RenderMode::triangles},
                                                                       {"full", RenderMode::full}}};
constexpr std::array<std::pair<const char*, ImpostorKind>, 2> kKinds = {
    {{"flat", ImpostorKind::flat}, {"A", ImpostorKind::depthCorrected}}};

Result<RenderMode> parseMode(const std::string& text) {
  for (const auto& [name, mode] : kModes)
    if (text == name) return mode;
  return fail(ErrorKind::invalidArgument, "--mode: expected auto, impostors, triangles or full, found '{}'", text);
}

Result<ImpostorKind> parseKind(const std::string& text) {
  for (const auto& [name, kind] : kKinds)
    if (text == name) return kind;
  return fail(ErrorKind::invalidArgument, "--kind: expected flat or A, found '{}'", text);
}

}  // namespace

void addDrawOptions(CLI::App& app, DrawOptions& options, const std::string& background) {
  app.add_option("pack", options.pack, "pack file (.far)")->required();
  app.add_option("--camera", options.cameras, "camera file; without it: an overview of the model");
  app.add_option("--camera-name", options.cameraName, "which camera of the file; default: the first");
  app.add_option("--size", options.size, "width x height in pixels")->capture_default_str();
  app.add_option("--mode", options.mode, "auto, impostors, triangles (all leaves in view) or full (all leaves)")
      ->capture_default_str();
  app.add_option("--kind", options.kind, "of impostors: flat or A (depth-corrected)")->capture_default_str();
  app.add_option("--triangle-budget", options.triangleBudget, "most triangles of a frame in mode auto")
      ->capture_default_str();
  app.add_option("--texel-pixels", options.texelPixels,
                 "an impostor's texel may be this large on screen, pixels; smaller: less error, more cells")
      ->check(CLI::Range(0.01, 100.0))
      ->capture_default_str();
  app.add_option("--samples", options.samples, "per pixel, of triangles: 1, 4 or 16")->capture_default_str();
  app.add_option("--background", options.background, "R,G,B of 0 to 255; default: " + background);
  app.add_option("--resident-bytes", options.residentBytes, "of the pack kept on the GPU")->capture_default_str();
}

Result<DrawPlan> planOf(const DrawOptions& options) {
  DrawPlan plan;
  FARCELL_ASSIGN(const ImageSize size, parseImageSize(options.size));
  FARCELL_ASSIGN(const uint64_t samples, parseCount(options.samples));
  FARCELL_ASSIGN(plan.settings.selection.mode, parseMode(options.mode));
  FARCELL_ASSIGN(plan.settings.kind, parseKind(options.kind));
  FARCELL_ASSIGN(plan.settings.selection.triangleBudget, parseCount(options.triangleBudget));
  plan.settings.selection.texelPixels = options.texelPixels;
  FARCELL_ASSIGN(plan.residentBytes, parseCount(options.residentBytes));
  if (samples != 1 && samples != 4 && samples != 16)
    return fail(ErrorKind::invalidArgument, "--samples: expected 1, 4 or 16, found {}", samples);
  if (options.cameras.empty() && !options.cameraName.empty())
    return fail(ErrorKind::invalidArgument, "--camera-name needs --camera");
  plan.settings.width = size.width;
  plan.settings.height = size.height;
  plan.settings.samplesPerPixel = static_cast<int>(samples);
  if (!options.background.empty()) {
    FARCELL_ASSIGN(plan.background, parseColour("--background", options.background));
  }
  return plan;
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
    if (value == mode) return name;
  return "";
}

const char* kindName(ImpostorKind kind) {
  for (const auto& [name, value] : kKinds)
    if (value == kind) return name;
  return "";
}

}  // namespace farcell
