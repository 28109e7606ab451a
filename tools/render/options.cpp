#include "tools/render/options.h"

#include "tools/cli/cli.h"

namespace farcell {
namespace {

Result<RenderMode> parseMode(const std::string& text) {
  if (text == "auto") return RenderMode::automatic;
  if (text == "impostors") return RenderMode::impostors;
  if (text == "triangles") return RenderMode::triangles;
  if (text == "full") return RenderMode::full;
  return fail(ErrorKind::invalidArgument, "--mode: expected auto, impostors, triangles or full, found '{}'", text);
}

Result<ImpostorKind> parseKind(const std::string& text) {
  if (text == "flat") return ImpostorKind::flat;
  if (text == "A") return ImpostorKind::depthCorrected;
  return fail(ErrorKind::invalidArgument, "--kind: expected flat or A, found '{}'", text);
}

}  // namespace

void addRenderOptions(CLI::App& app, RenderOptions& options) {
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
  app.add_option("--background", options.background, "R,G,B of 0 to 255; default: 179,204,230");
  app.add_option("--resident-bytes", options.residentBytes, "of the pack kept on the GPU")->capture_default_str();
  app.add_option("--repeat", options.repeat, "draw this often and report each frame; the first one reads the pack")
      ->capture_default_str()
      ->check(CLI::Range(1, 100000));
  app.add_option("--json", options.statsFile, "write figures as JSON to this file, - for stdout");
  app.add_option("-o,--output", options.output, "picture to write (.png)");
}

Result<RenderPlan> planOf(const RenderOptions& options) {
  RenderPlan plan;
  FARCELL_ASSIGN(const ImageSize size, parseImageSize(options.size));
  FARCELL_ASSIGN(const uint64_t samples, parseCount(options.samples));
  FARCELL_ASSIGN(plan.settings.selection.mode, parseMode(options.mode));
  FARCELL_ASSIGN(plan.settings.kind, parseKind(options.kind));
  FARCELL_ASSIGN(plan.settings.selection.triangleBudget, parseCount(options.triangleBudget));
  plan.settings.selection.texelPixels = options.texelPixels;
  FARCELL_ASSIGN(plan.residentBytes, parseCount(options.residentBytes));
  if (samples != 1 && samples != 4 && samples != 16)
    return fail(ErrorKind::invalidArgument, "--samples: expected 1, 4 or 16, found {}", samples);
  if (options.output.empty() && options.statsFile.empty())
    return fail(ErrorKind::invalidArgument, "nothing to do: neither -o nor --json is given");
  if (options.cameras.empty() && !options.cameraName.empty())
    return fail(ErrorKind::invalidArgument, "--camera-name needs --camera");
  plan.settings.width = size.width;
  plan.settings.height = size.height;
  plan.settings.samplesPerPixel = static_cast<int>(samples);
  plan.background = kDefaultBackground;
  if (!options.background.empty()) {
    FARCELL_ASSIGN(plan.background, parseColour("--background", options.background));
  }
  return plan;
}

}  // namespace farcell
