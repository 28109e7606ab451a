// farcell build: a pack from mesh files.
#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <string>

#include "cache/base/process.h"
#include "preprocess/build/build.h"
#include "tools/cli/cli.h"
#include "tools/report/build_report_json.h"
#include "tools/report/build_summary.h"

namespace farcell {
namespace {

struct Arguments {
  std::vector<std::filesystem::path> meshes;
  std::filesystem::path pack;
  BuildOptions options;
  std::string leafTriangles;
  std::string up;
  std::string unit;
  bool json = false;
  ProgressForm progress = ProgressForm::automatic;
};

void addOptions(CLI::App& app, Arguments& arguments) {
  BuildSettings& settings = arguments.options.settings;
  arguments.leafTriangles = std::to_string(settings.leafTriangles);
  app.add_option("mesh", arguments.meshes,
                 "mesh files, which are one model: .ply, .obj, .stl, .off, .gltf, .glb, or .json for a scene that "
                 "places others")
      ->required();
  app.add_option("-o,--output", arguments.pack, "pack file to write (.far)")->required();
  app.add_option("--views", settings.views, "viewpoints per cell")
      ->check(CLI::IsMember({"12", "42", "162", "642", "20", "80", "320", "1280"}))
      ->capture_default_str();
  app.add_option("--image-size", settings.imageSize, "texels along a view's edge")
      ->check(CLI::IsMember({"16", "32", "64", "128", "256", "512", "1024"}))
      ->capture_default_str();
  app.add_option("--samples", settings.samples, "samples per texel")
      ->check(CLI::IsMember({"1", "4", "16", "64"}))
      ->capture_default_str();
  app.add_option("--leaf-triangles", arguments.leafTriangles, "a cell of more triangles is split, e.g. 8k")
      ->type_name("COUNT")
      ->capture_default_str();
  app.add_option("--max-level", settings.maxLevel, "octree depth limit, 0 to 15")->capture_default_str();
  app.add_option("--fixed-level", settings.fixedLevel, "all leaves at this depth, as in the 2010 paper; -1: adaptive")
      ->capture_default_str();
  app.add_option("--up", arguments.up,
                 "up axis of the model; default: what the scene says, else y if the first file is .obj, .gltf or .glb, "
                 "else z")
      ->check(CLI::IsMember({"x", "y", "z"}));
  app.add_option(
         "--unit", arguments.unit,
         "length of a model unit: mm, cm, m, km, in, ft or metres as a number; default: what the scene says, else m")
      ->type_name("LENGTH");
  app.add_flag("--normals", settings.bakeNormals, "views also keep a normal");
  app.add_option("--threads", arguments.options.threads, "worker threads; 0: all")
      ->check(CLI::Range(0, 1024))
      ->capture_default_str();
  app.add_option(
         "--work-dir", arguments.options.workParent,
         "directory for scratch files, about 200 bytes a triangle, 300 in a textured model, and 6 a pixel of its "
         "textures; default: where the pack goes")
      ->type_name("DIR");
  app.add_flag("--json", arguments.json, "print the report as JSON on stdout");
  addProgressOption(app, arguments.progress);
}

// Empty: what the model says.
void chooseUp(const std::string& text, BuildOptions& options) {
  options.upOfModel = text.empty();
  if (!text.empty()) options.settings.up = *upAxisNamed(text);  // one of the names: the option's check
}

Result<> parseUnit(const std::string& text, BuildOptions& options) {
  options.unitOfModel = text.empty();
  if (text.empty()) return {};
  char* end = nullptr;
  const double number = std::strtod(text.c_str(), &end);
  const bool isNumber = end != text.c_str() && *end == '\0';
  const std::optional<double> metres = isNumber ? number : metresOfUnit(text);
  if (!metres)
    return fail(ErrorKind::invalidArgument, "--unit: expected mm, cm, m, km, in, ft or a number of metres, found '{}'",
                text);
  options.settings.metresPerUnit = *metres;
  return {};
}

// Both by reason.
void addLeftOut(BuildSummary& summary, const BuildReport& report) {
  for (const auto& [reason, count] : report.viewsLeftOut) summary.leftOut.push_back({"views", reason, count, {}});
  for (const auto& [reason, count] : report.skipped) summary.leftOut.push_back({"triangles", reason, count, {}});
}

BuildSummary summaryOf(const BuildResult& result) {
  const Directory& directory = result.directory;
  const BuildReport& report = directory.report;
  const StageSeconds& seconds = result.seconds;
  BuildSummary summary;
  summary.triangles = report.inputTriangles;
  summary.leaves = static_cast<uint64_t>(std::count_if(directory.cells.begin(), directory.cells.end(),
                                                       [](const CellRecord& cell) { return cell.childCount == 0; }));
  summary.innerCells = directory.cells.size() - summary.leaves;
  summary.viewsKept = report.viewsKept;
  summary.viewsBaked = report.viewsBaked;
  summary.stages = {{"read", seconds.read, {}, report.inputTriangles, "triangles", {}},
                    {"partition", seconds.partition, {}, report.inputTriangles, "triangles", {}},
                    {"lod", seconds.lod, {}, 0, "", {}},
                    {"bake", seconds.bake, {}, report.viewsBaked, "views", {}},
                    {"encode", seconds.encode, {}, report.viewsKept, "views", report.impostorBytes}};
  summary.seconds = seconds.total;
  summary.cpuSeconds = processCpuSeconds();
  summary.parts = {{"geometry", report.geometryBytes}, {"impostors", report.impostorBytes}};
  summary.packBytes = result.packBytes;
  summary.peakRssBytes = peakRssBytes();
  addLeftOut(summary, report);
  return summary;
}

nlohmann::ordered_json texturesJson(const TextureReport& textures) {
  nlohmann::ordered_json leftOut = nlohmann::ordered_json::array();
  for (const Error& error : textures.leftOut) leftOut.push_back(error.message);
  return {{"read", textures.read}, {"leftOut", leftOut}};
}

nlohmann::ordered_json filesJson(const std::vector<std::filesystem::path>& files) {
  nlohmann::ordered_json names = nlohmann::ordered_json::array();
  for (const std::filesystem::path& file : files) names.push_back(file.string());
  return names;
}

// Not an error: the pack is whole, if less colourful.
void warnOfTextures(const std::vector<Error>& leftOut) {
  constexpr size_t kMaxLines = 10;
  for (size_t i = 0; i < std::min(leftOut.size(), kMaxLines); ++i)
    fmt::print(stderr, "farcell build: texture left out: {}\n", leftOut[i].message);
  if (leftOut.size() > kMaxLines)
    fmt::print(stderr, "farcell build: {} more textures left out\n", leftOut.size() - kMaxLines);
}

Result<> run(Arguments& arguments) {
  BuildSettings& settings = arguments.options.settings;
  FARCELL_ASSIGN(const uint64_t leafTriangles, parseCount(arguments.leafTriangles));
  settings.leafTriangles = static_cast<int>(std::min<uint64_t>(leafTriangles, INT32_MAX));
  chooseUp(arguments.up, arguments.options);
  FARCELL_TRY(parseUnit(arguments.unit, arguments.options));
  Progress progress(arguments.progress);
  progress.budget("memory", 0, rssBytes);
  FARCELL_ASSIGN(const BuildResult result, buildPack(arguments.meshes, arguments.pack, arguments.options, progress));
  warnOfTextures(result.textures.leftOut);
  if (!arguments.json) {
    std::fputs(buildSummaryText(summaryOf(result)).c_str(), stdout);
    return {};
  }
  const StageSeconds& seconds = result.seconds;
  const BuildTimes times{seconds.read, seconds.partition, seconds.lod, seconds.bake, seconds.encode, seconds.total};
  const uint64_t peakRss = peakRssBytes();
  nlohmann::ordered_json report = buildReportJson(result.directory, result.packBytes, &times, &peakRss);
  report["textures"] = texturesJson(result.textures);
  report["files"] = filesJson(result.files);
  std::fputs(jsonText(report).c_str(), stdout);
  return {};
}

}  // namespace
}  // namespace farcell

int main(int argc, char** argv) {
  CLI::App app(
      "Builds a pack from mesh files.\n"
      "The meshes are streamed and cut into the cells of an octree; each cell keeps its triangles and small pictures "
      "of "
      "itself from many directions. Memory stays small whatever the size of the model; scratch files hold it "
      "meanwhile. The pack appears under its name when it is complete, and has the same bytes with any number of "
      "threads.",
      "farcell-build");
  app.footer(
      "Examples:\n"
      "  farcell build city.ply -o city.far\n"
      "  farcell build statue.obj --unit mm --views 162 -o statue.far --json > report.json\n"
      "  farcell build scene.json -o scene.far\n"
      "Progress:\n"
      "  --progress json   a line on stderr for each event, a few a second at most:\n"
      "                    {\"event\": \"begin\", \"advance\" or \"end\", \"stage\", \"unit\", \"done\", \"total\",\n"
      "                     \"seconds\", \"rate\", \"secondsLeft\", \"budgets\": [{\"name\", \"used\", \"limit\"}]},\n"
      "                    budgets in bytes; at the end {\"event\": \"done\", \"seconds\"}\n");
  farcell::Arguments arguments;
  farcell::addOptions(app, arguments);
  return farcell::runProgram(app, argc, argv, [&] { return farcell::run(arguments); });
}
