// farcell evaluate: how far a pack's pictures are from the full geometry, and what they cost.
#include <cstdio>

#include "tools/cli/cli.h"
#include "tools/evaluate/evaluate.h"
#include "tools/evaluate/path/camera_path.h"
#include "tools/evaluate/plan/renderers.h"
#include "tools/evaluate/plan/sweep.h"
#include "tools/options/draw_options.h"
#include "tools/options/light_options.h"

namespace farcell {
namespace {

// What the command line says as text.
struct Words {
  std::string size = "1280x720";
  std::string triangleBudget = "1M";
  std::string samples = kSamples;
  std::string background = "179,204,230";
  uint64_t residentMib = 1024;
  std::string occlusion = "off";
  LightOptions light;
};

Result<> run(EvaluateOptions& options, const Words& words) {
  FARCELL_ASSIGN(const ImageSize size, parseImageSize(words.size));
  options.width = size.width;
  options.height = size.height;
  FARCELL_ASSIGN(options.selection.triangleBudget, parseCount(words.triangleBudget));
  options.samples = samplesNamed(words.samples);
  FARCELL_ASSIGN(const auto background, parseColour("--background", words.background));
  options.background =
      Colour{static_cast<float>(background[0]), static_cast<float>(background[1]), static_cast<float>(background[2])};
  options.residentBytes = words.residentMib << 20;
  options.occlusion = words.occlusion == "on";
  FARCELL_ASSIGN(options.light, lightOf(words.light));
  if (options.cameras.empty() && options.autoCameras == 0 && options.paths.empty())
    return fail(ErrorKind::invalidArgument, "one of --cameras, --auto-cameras and --path is needed");
  return evaluate(options);
}

void addSelectionOptions(CLI::App& app, EvaluateOptions& options, Words& words) {
  app.add_option("--triangle-budget", words.triangleBudget, "triangles a frame of 'auto' may draw, e.g. 500k")
      ->type_name("COUNT")
      ->capture_default_str();
  app.add_option("--time-budget-ms", options.selection.timeBudgetMs,
                 "of 'auto': the least error in a frame of so many milliseconds, by what drawing was measured to cost "
                 "on this machine at the first such start; 0: no such budget")
      ->type_name("MS")
      ->check(CLI::Range(0.0, kMostTimeBudgetMs))
      ->capture_default_str();
  app.add_flag("--recalibrate", options.recalibrate, "measure again what drawing costs on this machine");
  app.add_option("--occlusion", words.occlusion, "leave out what nearer triangles hide; on is an experiment")
      ->check(CLI::IsMember({"on", "off"}))
      ->capture_default_str();
  app.add_option("--texel-pixels", options.selection.texelPixels,
                 "an impostor's texel may be this large on screen, pixels; smaller: less error, more cells")
      ->check(CLI::Range(kLeastTexelPixels, kMostTexelPixels))
      ->capture_default_str();
  app.add_option(
         "--mesh-pixels", options.selection.meshPixels,
         "a simplified mesh of 'auto' may be this far from the full surface on screen, pixels; 0: none is drawn")
      ->check(CLI::Range(0.0, kMostMeshPixels))
      ->capture_default_str();
}

void addSeen(CLI::App& app, EvaluateOptions& options) {
  auto* cameras = app.add_option("--cameras", options.cameras, "camera file (JSON)");
  app.add_option("--auto-cameras", options.autoCameras,
                 "instead: this many cameras between the baked directions, .25 to 8 diameters away")
      ->check(CLI::Range(1, 1000))
      ->excludes(cameras);
  app.add_option("--path", options.paths,
                 "a camera that moves: orbit, flyby, street (made for the model) or a camera file whose cameras are "
                 "keyframes of a smooth path, \"time\" in seconds their own member; once for each path")
      ->type_name("PATH")
      ->allow_extra_args(false);
  app.add_option("--path-frames", options.pathFrames, "frames of each path")
      ->check(CLI::Range(2, kMaxPathFrames))
      ->capture_default_str();
  app.add_option("--path-seed", options.pathSeed, "draws place and direction of the paths made for the model")
      ->capture_default_str();
}

void addRenderers(CLI::App& app, EvaluateOptions& options) {
  app.add_option(
         "--renderers", options.renderers,
         "comma-separated; full-1spp and full-4spp are always included; of cameras only: "
         "lod-as-auto, meshes whose error is searched so that a frame takes as long as one of auto; octahedral, "
         "16 x 16 views of the whole model as game engines have them, in the memory that auto needs at most")
      ->type_name("NAMES")
      ->default_val(kAllRenderers);
  app.add_option("--against", options.against,
                 "another pack of the same model (built from the same files), whose renderers are named with @NAME, as "
                 "in --renderers auto,flat@paper; once for each pack")
      ->type_name("NAME=PACK")
      ->allow_extra_args(false);
  app.add_option(
         "--sweep", options.sweeps,
         "texel-pixels=0.35,0.5, mesh-pixels=1,4, triangle-budget=100k,2M or time-budget-ms=16,33: each renderer that "
         "has the setting, once for each value; given for several: for each combination; at most 64 renderers in all")
      ->type_name("NAME=VALUES")
      ->allow_extra_args(false);
}

void addOptions(CLI::App& app, EvaluateOptions& options, Words& words) {
  app.add_option("pack", options.pack, "pack file (.far)")->required();
  addSeen(app, options);
  app.add_option("--mesh", options.meshes,
                 "the file the pack was built from, as the truth instead of the pack's own triangles (held in memory); "
                 "once for each file, in the order of the build")
      ->allow_extra_args(false);
  app.add_option("--size", words.size, "width x height in pixels, 1x1 to 16384x16384")
      ->type_name("WxH")
      ->capture_default_str();
  addRenderers(app, options);
  app.add_option("--reference-samples", options.referenceSamples, "samples per pixel of the reference")
      ->check(CLI::IsMember({"1", "4", "9", "16", "25", "36", "49", "64"}))
      ->capture_default_str();
  app.add_option("--samples", words.samples,
                 "samples per pixel of every renderer but full geometry; auto: 8 where triangles fill a fifth of the "
                 "picture, else 4")
      ->check(CLI::IsMember(kSampleWords))
      ->capture_default_str();
  addSelectionOptions(app, options, words);
  app.add_option("--lod-pixels", options.lodPixels, "the same of 'lod', which draws meshes only")
      ->check(CLI::Range(kLeastMeshPixels, kMostMeshPixels))
      ->capture_default_str();
  app.add_option("--frames", options.timedFrames, "warm frames that are timed")
      ->check(CLI::Range(1, 1000))
      ->capture_default_str();
  addLightOptions(app, words.light);
  app.add_option("--suns", options.suns,
                 "of a relightable pack: the cameras again under so many suns spread over the sky; figures only")
      ->check(CLI::Range(0, 100))
      ->capture_default_str();
  app.add_option("--background", words.background, "colour behind every picture, 0 to 255 each")
      ->type_name("R,G,B")
      ->capture_default_str();
  app.add_option("--resident-mib", words.residentMib,
                 "how much of the pack may stay on the GPU, MiB; of each renderer of a path")
      ->type_name("MIB")
      ->check(CLI::Range(1, 1 << 20))
      ->capture_default_str();
  app.add_flag("--json", options.json, "print report.json instead of a table");
  addProgressOption(app, options.progress);
  app.add_option("-o,--output", options.output,
                 "directory of the report, made when absent; its index.html opens in a browser")
      ->required()
      ->type_name("DIR");
}

}  // namespace
}  // namespace farcell

int main(int argc, char** argv) {
  farcell::EvaluateOptions options;
  farcell::Words words;
  CLI::App app(
      "Measures a pack's pictures against its full geometry.\n"
      "For each camera a reference is ray traced; each renderer's picture is compared with it and timed. The report is "
      "report.json, report.csv (a line a picture), summary.csv (a line a renderer: error, time, Pareto fronts), "
      "equal.csv (at auto's time and at auto's error), suns.csv (a line a picture under another sun), paths.csv (a "
      "line a frame of a path), and a page with plots and "
      "pictures of the differences.",
      "farcell-evaluate");
  app.footer(
      "Examples:\n"
      "  farcell evaluate city.far --cameras cams.json -o report/\n"
      "  farcell evaluate city.far --auto-cameras 8 --renderers flat,A,auto --size 640x360 -o report/\n"
      "  farcell evaluate city.far --cameras cams.json --sweep texel-pixels=0.35,0.5,1 -o report/\n"
      "  farcell evaluate city.far --path drive.json --path orbit --renderers A,auto -o report/\n"
      "  farcell evaluate city.far --auto-cameras 8 --against p=flat.far --renderers auto,flat@p -o report/\n");
  farcell::addOptions(app, options, words);
  return farcell::runProgram(app, argc, argv, [&] { return farcell::run(options, words); });
}
