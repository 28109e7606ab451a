#include "tools/view/view_options.h"

namespace farcell {

void addViewOptions(CLI::App& app, ViewOptions& options) {
  addDrawOptions(app, options, "a sky");
  app.add_option("--frames", options.frames,
                 "draw this many frames, once around the pivot, say how long each took, quit")
      ->check(CLI::Range(1, 100000));
  app.add_option("--json", options.statsFile, "with --frames: write figures as JSON to this file, - for stdout");
  app.add_option("--screenshot", options.screenshot, "write the first picture to this file (.png) and quit");
}

std::string renderCommand(const DrawOptions& options, const RenderSettings& settings, const std::string& pack,
                          const std::string& cameraFile) {
  std::string command = fmt::format(
      "farcell render '{}' --camera '{}' --size {}x{} --mode {} --kind {} --samples {} --triangle-budget {} "
      "--texel-pixels {} --mesh-pixels {}",
      pack, cameraFile, settings.width, settings.height, modeName(settings.selection.mode), kindName(settings.kind),
      samplesText(settings.samplesPerPixel), settings.selection.triangleBudget, settings.selection.texelPixels,
      settings.selection.meshPixels);
  if (settings.selection.timeBudgetMs > 0)
    command += fmt::format(" --time-budget-ms {}", settings.selection.timeBudgetMs);
  if (settings.show != Show::picture) command += fmt::format(" --show {}", showName(settings.show));
  if (settings.light.kind == LightKind::headlight) command += " --light headlight";
  if (settings.light.kind == LightKind::sun && settings.light.sun) command += " --sun " + sunText(*settings.light.sun);
  if (!options.background.empty()) command += " --background " + options.background;
  return command;
}

}  // namespace farcell
