#include "tools/render/options.h"

#include <map>

#include "tools/cli/cli.h"

namespace farcell {
namespace {

const std::map<std::string, RenderMode> kModes = {{"auto", RenderMode::automatic},
                                                  {"impostors", RenderMode::impostors},
                                                  {"triangles", RenderMode::triangles},
                                                  {"full", RenderMode::full}};
const std::map<std::string, ImpostorKind> kKinds = {{"flat", ImpostorKind::flat}, {"A", ImpostorKind::depthCorrected}};

}  // namespace

void addRenderOptions(CLI::App& app, RenderOptions& options) {
  app.add_option("pack", options.pack, "pack file (.far)")->required();
  app.add_option("--camera", options.cameras, "camera file (JSON); without it: an overview of the model");
  app.add_option("--camera-name", options.cameraName, "which camera of the file; default: the first")
      ->type_name("NAME");
  app.add_option("--size", options.size, "width x height in pixels, 1x1 to 16384x16384")
      ->type_name("WxH")
      ->capture_default_str();
  app.add_option("--mode", options.mode, "what is drawn; triangles: all leaves in view, full: all leaves")
      ->check(CLI::IsMember(kModes))
      ->capture_default_str();
  app.add_option("--kind", options.kind, "of impostors: A is depth-corrected")
      ->check(CLI::IsMember(kKinds))
      ->capture_default_str();
  app.add_option("--triangle-budget", options.triangleBudget, "most triangles of a frame in mode auto, e.g. 500k")
      ->type_name("COUNT")
      ->capture_default_str();
  app.add_option("--texel-pixels", options.texelPixels,
                 "an impostor's texel may be this large on screen, pixels; smaller: less error, more cells")
      ->check(CLI::Range(0.01, 100.0))
      ->capture_default_str();
  app.add_option("--samples", options.samples, "samples per pixel, of triangles")
      ->check(CLI::IsMember({"1", "4", "16"}))
      ->capture_default_str();
  app.add_option("--background", options.background, "colour behind the model, 0 to 255 each; default: 179,204,230")
      ->type_name("R,G,B");
  app.add_option("--resident-bytes", options.residentBytes, "how many bytes of the pack are kept on the GPU, e.g. 500M")
      ->type_name("COUNT")
      ->capture_default_str();
  app.add_option("--repeat", options.repeat, "draw this often and report each frame; the first one reads the pack")
      ->capture_default_str()
      ->check(CLI::Range(1, 100000));
  app.add_option("--json", options.statsFile, "write figures as JSON to this file, - for stdout");
  app.add_option("-o,--output", options.output, "picture to write (.png)");
}

Result<RenderPlan> planOf(const RenderOptions& options) {
  RenderPlan plan;
  FARCELL_ASSIGN(const ImageSize size, parseImageSize(options.size));
  plan.settings.selection.mode = kModes.at(options.mode);
  plan.settings.kind = kKinds.at(options.kind);
  FARCELL_ASSIGN(plan.settings.selection.triangleBudget, parseCount(options.triangleBudget));
  plan.settings.selection.texelPixels = options.texelPixels;
  FARCELL_ASSIGN(plan.residentBytes, parseCount(options.residentBytes));
  if (options.output.empty() && options.statsFile.empty())
    return fail(ErrorKind::invalidArgument, "nothing to do: neither -o nor --json is given");
  if (options.cameras.empty() && !options.cameraName.empty())
    return fail(ErrorKind::invalidArgument, "--camera-name needs --camera");
  plan.settings.width = size.width;
  plan.settings.height = size.height;
  plan.settings.samplesPerPixel = options.samples;
  plan.background = kDefaultBackground;
  if (!options.background.empty()) {
    FARCELL_ASSIGN(plan.background, parseColour("--background", options.background));
  }
  return plan;
}

}  // namespace farcell
