#include "tools/build/program/build_program.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
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
  std::string memory;
  std::string packBudget;
  std::string budgetRule = "worth";
  std::string simplifier = "collapse";
  std::string measure = "sample";
  std::string lighting = "baked";
  std::string forms = formsName(Forms::fixed);
  std::string sun;  // empty: the default
  std::string up;
  std::string unit;
  bool mpi = false;
  bool json = false;
  ProgressForm progress = ProgressForm::automatic;
};

void addFormOptions(CLI::App& app, Arguments& arguments) {
  ViewForm& form = arguments.options.settings.form;
  app.add_option("--forms", arguments.forms,
                 "number and size of the views of cells: fixed, those of the two options below; by-height, from these: "
                 "leaves have fewer and larger ones, cells high above them more and larger ones; chosen, each level "
                 "has its own by measured error, in no more bytes than fixed ones would take")
      ->check(CLI::IsMember({"fixed", "by-height", "chosen"}))
      ->capture_default_str();
  app.add_option("--views", form.views, "viewpoints per cell")
      ->check(CLI::IsMember({"12", "42", "162", "642", "20", "80", "320", "1280"}))
      ->capture_default_str();
  app.add_option("--image-size", form.imageSize, "texels along a view's edge")
      ->check(CLI::IsMember({"16", "32", "64", "128", "256", "512", "1024"}))
      ->capture_default_str();
}

// What the pack is to hold.
void addContentOptions(CLI::App& app, Arguments& arguments) {
  BuildSettings& settings = arguments.options.settings;
  arguments.leafTriangles = std::to_string(settings.leafTriangles);
  addFormOptions(app, arguments);
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
  app.add_option("--lighting", arguments.lighting,
                 "of views: baked, lit by one sun, in the fewest bytes; relightable: with normals, lit by any sun or "
                 "headlight when they are drawn")
      ->check(CLI::IsMember({"baked", "relightable"}))
      ->capture_default_str();
  app.add_option("--sun", arguments.sun,
                 "where the sun stands, degrees: around the up axis (z up: from x towards y) and above the horizon")
      ->type_name("AZIMUTH,ELEVATION")
      ->default_str(sunText(settings.sun));
  app.add_option("--view-error", settings.viewError,
                 "how far a channel of a view's texel (coverage, colour, depth, normal) may be from what was baked, in "
                 "255ths, 0 to 8: more takes fewer bytes; 0: lossless")
      ->capture_default_str();
  app.add_option("--measure", arguments.measure,
                 "cells whose image errors are measured, for the others' to be expected by: a sample, all, or none")
      ->check(CLI::IsMember({"sample", "all", "off"}))
      ->capture_default_str();
  app.add_option("--simplifier", arguments.simplifier,
                 "what makes the meshes of inner cells: edge collapses, or OpenMesh's decimater, which is slower")
      ->check(CLI::IsMember({"collapse", "openmesh"}))
      ->capture_default_str();
  app.add_option("--visitable", arguments.options.visitable,
                 "where visitors may be: everywhere, above-ground, or a .json file of boxes, a path or cameras; views "
                 "that nobody there can have are left out")
      ->type_name("REGION")
      ->capture_default_str();
  app.add_option("--pack-budget", arguments.packBudget,
                 "the pack is no larger than this, e.g. 4G (powers of 1024); default: no limit")
      ->type_name("BYTES");
  app.add_option("--budget-rule", arguments.budgetRule,
                 "what the budget is spent on first: views most worth a byte, or cells of most triangles")
      ->check(CLI::IsMember({"worth", "triangles"}))
      ->capture_default_str();
}

void addOptions(CLI::App& app, Arguments& arguments) {
  app.add_option("mesh", arguments.meshes,
                 "mesh files, which are one model: .ply, .obj, .stl, .off, .gltf, .glb, or .json for a scene that "
                 "places others")
      ->required();
  app.add_option("-o,--output", arguments.pack, "pack file to write (.far)")->required();
  addContentOptions(app, arguments);
  arguments.memory = fmt::format("{}G", kDefaultMemoryBytes >> 30);
  app.add_option("--memory", arguments.memory,
                 "ceiling of this process's memory, at least 192M; K, M, G are powers of 1024")
      ->type_name("BYTES")
      ->capture_default_str();
  app.add_option("--threads", arguments.options.threads, "worker threads; 0: all")
      ->check(CLI::Range(0, 1024))
      ->capture_default_str();
  app.add_option(
         "--work-dir", arguments.options.workParent,
         "where the work directory lies, which an interrupted build goes on from: about 200 bytes a triangle, 300 in "
         "a textured model, and 6 a pixel of its textures; default: where the pack goes")
      ->type_name("DIR");
  app.add_flag("--mpi", arguments.mpi, "share the work with the other processes of an mpirun, by the work directory");
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
  for (const auto& [reason, count] : report.viewsLeftOut) {
    const auto bytes = report.bytesLeftOut.find(reason);
    const bool known = bytes != report.bytesLeftOut.end();
    summary.leftOut.push_back({"views", reason, count, known ? std::optional(bytes->second) : std::nullopt});
  }
  for (const auto& [reason, count] : report.skipped) summary.leftOut.push_back({"triangles", reason, count, {}});
}

constexpr std::array<const char*, kErrorWays> kWayNames = {"mesh", "depthCorrected", "blended"};

void addExpected(BuildSummary& summary, const MeasureReport& measured) {
  for (size_t way = 0; way < kErrorWays; ++way) {
    BuildSummary::Expected row{kWayNames[way], measured.apart[way][0].cells, {}, {}, {}};
    for (size_t scale = 0; scale < kErrorScales; ++scale) {
      row.scales.push_back(fmt::format("{} px", kErrorTexelPixels[scale]));
      row.median.push_back(measured.apart[way][scale].median);
      row.ninetieth.push_back(measured.apart[way][scale].ninetieth);
    }
    if (row.cells > 0) summary.expected.push_back(std::move(row));
  }
}

void addForms(BuildSummary& summary, const MeasureReport& measured) {
  for (const KindForms& kind : measured.forms.kinds) {
    const ViewForm form = candidateForm(kind.chosen);
    summary.forms.push_back({fmt::format("level {} {}", kind.kind.level, kind.kind.leaf ? "leaves" : "inner"),
                             kind.cells, form.views, form.imageSize, kind.means.bytes[kind.chosen]});
  }
}

nlohmann::ordered_json candidatesJson(const FormMeans& means) {
  nlohmann::ordered_json json = nlohmann::ordered_json::array();
  for (size_t i = 0; i < kCandidates; ++i)
    json.push_back({{"views", candidateForm(i).views},
                    {"imageSize", candidateForm(i).imageSize},
                    {"bytesOfCell", means.bytes[i]},
                    {"depthCorrected", means.candidates[i]},
                    {"blended", means.blended[i]}});
  return json;
}

nlohmann::ordered_json formsJson(const ChosenForms& forms) {
  const auto pointJson = [](const FormsPoint& point) {
    return nlohmann::ordered_json{{"bytes", point.bytes}, {"error", point.error}};
  };
  nlohmann::ordered_json kinds = nlohmann::ordered_json::array(), pareto = nlohmann::ordered_json::array();
  for (const FormsPoint& point : forms.pareto) pareto.push_back(pointJson(point));
  for (const KindForms& kind : forms.kinds)
    kinds.push_back({{"level", kind.kind.level},
                     {"leaves", kind.kind.leaf},
                     {"cells", kind.cells},
                     {"measured", kind.measured},
                     {"share", kind.share},
                     {"views", candidateForm(kind.chosen).views},
                     {"imageSize", candidateForm(kind.chosen).imageSize},
                     {"triangles", kind.means.triangles},
                     {"candidates", candidatesJson(kind.means)}});
  return {{"picturePixels", kPictureEdges},
          {"fixed", pointJson(forms.fixed)},
          {"chosen", pointJson(forms.chosen)},
          {"pareto", pareto},
          {"kinds", kinds}};
}

nlohmann::ordered_json measuredJson(const BuildResult& result) {
  const MeasureReport& measured = result.measured;
  nlohmann::ordered_json expected = nlohmann::ordered_json::array();
  for (size_t way = 0; way < kErrorWays; ++way)
    for (size_t scale = 0; scale < kErrorScales; ++scale) {
      const ExpectedApart& apart = measured.apart[way][scale];
      if (apart.cells == 0) continue;
      expected.push_back({{"way", kWayNames[way]},
                          {"texelPixels", kErrorTexelPixels[scale]},
                          {"cells", apart.cells},
                          {"medianOff", apart.median},
                          {"ninetiethOff", apart.ninetieth}});
    }
  return {{"cells", measured.cells},
          {"cpuSeconds", result.cpuSeconds.measure},
          {"unit", measured.unit},
          {"expected", expected},
          {"forms", formsJson(measured.forms)}};
}

BuildSummary summaryOf(const BuildResult& result, const BuildOptions& options) {
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
  summary.stages = {
      {"read", seconds.read, {}, report.inputTriangles, "triangles", {}},
      {"partition", seconds.partition, {}, report.inputTriangles, "triangles", {}},
      {"lod", seconds.lod, result.cpuSeconds.lod, report.inputTriangles, "triangles", {}},
      {"bake", seconds.bake, result.cpuSeconds.bake, report.viewsBaked, "views", {}},
      {"encode", seconds.encode, result.cpuSeconds.encode, report.viewsKept, "views", report.impostorBytes},
      {"measure", seconds.measure, result.cpuSeconds.measure, result.measured.cells, "cells", {}}};
  summary.seconds = seconds.total;
  summary.cpuSeconds = processCpuSeconds();
  summary.parts = {{"geometry", report.geometryBytes}, {"impostors", report.impostorBytes}};
  if (report.textureBytes > 0) summary.parts.push_back({"textures", report.textureBytes});
  summary.packBytes = result.packBytes;
  summary.packBudget = options.settings.packBudgetBytes;
  summary.peakRssBytes = peakRssBytes();
  summary.memoryLimit = options.memoryBytes;
  addLeftOut(summary, report);
  addExpected(summary, result.measured);
  addForms(summary, result.measured);
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

// With --mpi the program that knows of MPI, which lies beside this one, takes its place.
Result<> becomeMpi(char** argv) {
  std::error_code error;
  const auto self = std::filesystem::read_symlink("/proc/self/exe", error);
  const std::string program = (self.parent_path() / "farcell-build-mpi").string();
  ::execv(program.c_str(), argv);
  return fail(ErrorKind::unsupported, "--mpi: cannot run {}: {}", program, std::strerror(errno));
}

Result<> chooseMemory(Arguments& arguments) {
  FARCELL_ASSIGN(arguments.options.memoryBytes, parseBytes(arguments.memory));
  if (arguments.packBudget.empty()) return {};
  FARCELL_ASSIGN(arguments.options.settings.packBudgetBytes, parseBytes(arguments.packBudget));
  if (arguments.options.settings.packBudgetBytes > 0) return {};
  return fail(ErrorKind::invalidArgument, "--pack-budget: expected at least 1 byte, found 0");
}

Result<> run(Arguments& arguments, Crew* crew, char** argv) {
  if (arguments.mpi && crew == nullptr) return becomeMpi(argv);
  BuildSettings& settings = arguments.options.settings;
  settings.simplifier = arguments.simplifier == "openmesh" ? Simplifier::openmesh : Simplifier::collapse;
  settings.measure = arguments.measure == "off"   ? Measure::off
                     : arguments.measure == "all" ? Measure::all
                                                  : Measure::sample;
  settings.forms = formsNamed(arguments.forms).value();
  settings.lighting = arguments.lighting == "relightable" ? Lighting::relightable : Lighting::baked;
  if (!arguments.sun.empty()) {
    FARCELL_ASSIGN(settings.sun, parseSun("--sun", arguments.sun));
  }
  settings.budgetRule = arguments.budgetRule == "triangles" ? BudgetRule::triangles : BudgetRule::worth;
  FARCELL_TRY(chooseMemory(arguments));
  FARCELL_ASSIGN(const uint64_t leafTriangles, parseCount(arguments.leafTriangles));
  settings.leafTriangles = static_cast<int>(std::min<uint64_t>(leafTriangles, INT32_MAX));
  chooseUp(arguments.up, arguments.options);
  FARCELL_TRY(parseUnit(arguments.unit, arguments.options));
  const bool leads = crew == nullptr || crew->rank() == 0;
  arguments.options.crew = crew;
  if (leads && arguments.progress != ProgressForm::none && arguments.progress != ProgressForm::json)
    arguments.options.tell = [](const std::string& line) { fmt::print(stderr, "{}\n", line); };
  Progress progress(leads ? arguments.progress : ProgressForm::none);
  progress.budget("memory", arguments.options.memoryBytes, rssBytes);
  FARCELL_ASSIGN(const BuildResult result, buildPack(arguments.meshes, arguments.pack, arguments.options, progress));
  if (!leads) return {};
  warnOfTextures(result.textures.leftOut);
  if (!arguments.json) {
    std::fputs(buildSummaryText(summaryOf(result, arguments.options)).c_str(), stdout);
    return {};
  }
  const StageSeconds& seconds = result.seconds;
  const BuildTimes times{seconds.read, seconds.partition, seconds.lod, seconds.bake, seconds.encode, seconds.total};
  const uint64_t peakRss = peakRssBytes();
  nlohmann::ordered_json report = buildReportJson(result.directory, result.packBytes, &times, &peakRss);
  report["measured"] = measuredJson(result);
  report["textures"] = texturesJson(result.textures);
  report["files"] = filesJson(result.files);
  std::fputs(jsonText(report).c_str(), stdout);
  return {};
}

}  // namespace

int buildProgram(int argc, char** argv, Crew* crew) {
  CLI::App app(
      "Builds a pack from mesh files.\n"
      "The meshes are streamed and cut into the cells of an octree; each cell keeps its triangles and small pictures "
      "of "
      "itself from many directions; inner cells keep simplified meshes. Memory stays below a ceiling whatever the size "
      "of the model; a work directory beside the pack holds it meanwhile. A build that was interrupted or killed goes "
      "on "
      "where it was when the same command is given again. The pack appears under its name when it is complete, and has "
      "the same bytes with any number of threads and processes.",
      "farcell-build");
  app.footer(
      "Examples:\n"
      "  farcell build city.ply -o city.far\n"
      "  farcell build statue.obj --unit mm --views 162 -o statue.far --json > report.json\n"
      "  farcell build scene.json -o scene.far\n"
      "  farcell build city.ply -o city.far --visitable above-ground --pack-budget 500M\n"
      "  mpirun -n 16 farcell build --mpi city.ply -o /shared/city.far\n"
      "Progress:\n"
      "  --progress json   a line on stderr for each event, a few a second at most:\n"
      "                    {\"event\": \"begin\", \"advance\" or \"end\", \"stage\", \"unit\", \"done\", \"total\",\n"
      "                     \"seconds\", \"rate\", \"secondsLeft\", \"budgets\": [{\"name\", \"used\", \"limit\"}]},\n"
      "                    budgets in bytes; at the end {\"event\": \"done\", \"seconds\"}\n");
  Arguments arguments;
  addOptions(app, arguments);
  return runProgram(app, argc, argv, [&] { return run(arguments, crew, argv); });
}

}  // namespace farcell
