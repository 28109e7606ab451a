// farcell-render: one picture of a pack from one camera, and what it cost.
#include <algorithm>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "cache/base/file.h"
#include "cache/base/interrupt.h"
#include "tools/cli/cli.h"
#include "tools/image/png.h"
#include "tools/options/draw_options.h"

namespace farcell {
namespace {

struct RenderOptions : DrawOptions {
  int repeat = 1;
  std::string output;
  std::string statsFile;  // empty: none; "-": stdout
};

void addRenderOptions(CLI::App& app, RenderOptions& options) {
  addDrawOptions(app, options, "179,204,230");
  app.add_option("--repeat", options.repeat, "draw this often and report each frame; the first one reads the pack")
      ->capture_default_str()
      ->check(CLI::Range(1, 100000));
  app.add_option("--json", options.statsFile, "write figures as JSON to this file, - for stdout");
  app.add_option("-o,--output", options.output, "picture to write (.png)");
}

nlohmann::json frameJson(const FrameStats& stats) {
  return {{"wallMs", stats.wallMs},
          {"cpuMs", stats.cpuMs},
          {"triangles", stats.triangles},
          {"meshes", stats.meshes},
          {"impostors", stats.impostors},
          {"texels", stats.texels},
          {"bytesRead", stats.bytesRead},
          {"expectedMs", stats.expectedMs},
          {"expectedLoss", stats.expectedLoss},
          {"lossBound", stats.lossBound},
          {"hidden",
           {{"cells", stats.hiddenCells},
            {"triangles", stats.hiddenTriangles},
            {"bytes", stats.hiddenBytes},
            {"expectedMs", stats.hiddenMs},
            {"searchMs", stats.occlusionMs}}}};
}

// Frames after the first, which reads the pack; the first where it is the only one.
double medianWarmMs(const std::vector<FrameStats>& frames) {
  std::vector<double> times;
  for (size_t i = frames.size() > 1 ? 1 : 0; i < frames.size(); ++i) times.push_back(frames[i].wallMs);
  std::sort(times.begin(), times.end());
  return times[times.size() / 2];
}

nlohmann::json legendJson(const std::vector<LegendEntry>& legend) {
  nlohmann::json json = nlohmann::json::array();
  for (const LegendEntry& entry : legend) json.push_back({{"meaning", entry.meaning}, {"colour", entry.colour}});
  return json;
}

void printLegend(const std::vector<LegendEntry>& legend) {
  for (const LegendEntry& entry : legend)
    std::fprintf(stderr, "  #%02x%02x%02x  %s\n", entry.colour[0], entry.colour[1], entry.colour[2],
                 entry.meaning.c_str());
}

Result<> writeFigures(const std::string& path, const std::string& renderer, Show show,
                      const std::vector<FrameStats>& frames) {
  nlohmann::json list = nlohmann::json::array();
  for (const FrameStats& stats : frames) list.push_back(frameJson(stats));
  nlohmann::json figures = {{"openGl", renderer}, {"frames", list}, {"medianWarmMs", medianWarmMs(frames)}};
  if (show != Show::picture) {
    figures["show"] = showName(show);
    figures["legend"] = legendJson(frames.back().legend);
  }
  const std::string text = figures.dump(2) + "\n";
  if (path != "-") return writeTextFile(path, text);
  std::fputs(text.c_str(), stdout);
  return {};
}

Result<> run(const RenderOptions& options) {
  FARCELL_ASSIGN(DrawPlan plan, planOf(options));
  if (options.output.empty() && options.statsFile.empty())
    return fail(ErrorKind::invalidArgument, "nothing to do: neither -o nor --json is given");
  FARCELL_ASSIGN(const PackFile pack, PackFile::open(options.pack));
  FARCELL_ASSIGN(const Camera camera,
                 chooseCamera(options, pack.directory().model, plan.settings.width, plan.settings.height));
  FARCELL_ASSIGN(GlContext context, GlContext::createHeadless());
  FARCELL_TRY(applyMachineCosts(context, plan.recalibrate, plan.settings));
  FARCELL_ASSIGN(Renderer renderer, Renderer::create(context, pack, plan.residentBytes));
  std::vector<FrameStats> frames;
  for (int i = 0; i < options.repeat; ++i) {
    FARCELL_TRY(checkInterrupt());
    FARCELL_ASSIGN(const FrameStats stats, renderer.draw(camera, plan.settings, nullptr));
    frames.push_back(stats);
  }
  if (!options.output.empty()) {
    FrameImage image;
    FARCELL_TRY(renderer.draw(camera, plan.settings, &image));
    const auto behind = plan.background.value_or(kDefaultBackground);
    FARCELL_TRY(writePng(options.output, {image.width, image.height, 3, overBackground(image.rgba, behind)}));
  }
  if (!options.statsFile.empty()) {
    FARCELL_TRY(writeFigures(options.statsFile, context.renderer(), plan.settings.show, frames));
  }
  const FrameStats& last = frames.back();
  std::fprintf(stderr, "%.1f ms, %llu triangles, %llu meshes, %llu impostors, %llu texels (%s)\n", medianWarmMs(frames),
               static_cast<unsigned long long>(last.triangles), static_cast<unsigned long long>(last.meshes),
               static_cast<unsigned long long>(last.impostors), static_cast<unsigned long long>(last.texels),
               context.renderer().c_str());
  printLegend(last.legend);
  return {};
}

}  // namespace
}  // namespace farcell

int main(int argc, char** argv) {
  CLI::App app(
      "Draws one picture of a pack.\n"
      "Near cells are drawn as triangles, within a budget, in full or simplified, the rest as impostors. What --show's "
      "colours mean is "
      "printed "
      "on stderr, and with --json as \"legend\". OpenGL 4.5 is needed, of a GPU or of Mesa's software renderer; no "
      "window is.",
      "farcell-render");
  app.footer(
      "Examples:\n"
      "  farcell render city.far --size 1280x720 -o city.png\n"
      "  farcell render city.far --camera cams.json --camera-name street --repeat 5 --json -\n"
      "  farcell render city.far --show error -o error.png\n");
  farcell::RenderOptions options;
  farcell::addRenderOptions(app, options);
  return farcell::runProgram(app, argc, argv, [&] { return farcell::run(options); });
}
