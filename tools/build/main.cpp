// farcell build: a pack from a mesh file.
#include <fmt/format.h>

#include <cstdio>
#include <filesystem>
#include <string>

#include "cache/base/process.h"
#include "preprocess/build/build.h"
#include "tools/cli/cli.h"
#include "tools/report/build_report_json.h"

namespace farcell {
namespace {

struct Arguments {
  std::filesystem::path mesh;
  std::filesystem::path pack;
  BuildOptions options;
  std::string leafTriangles;
  std::string up;
  std::string unit = "m";
  bool json = false;
  bool quiet = false;
};

void addOptions(CLI::App& app, Arguments& arguments) {
  BuildSettings& settings = arguments.options.settings;
  arguments.leafTriangles = std::to_string(settings.leafTriangles);
  app.add_option("mesh", arguments.mesh, "mesh file: .ply or .obj")->required();
  app.add_option("-o,--output", arguments.pack, "pack file to write")->required();
  app.add_option("--views", settings.views, "viewpoints per cell: 12, 42, 162, 642 or 20, 80, 320, 1280")
      ->capture_default_str();
  app.add_option("--image-size", settings.imageSize, "texels along a view's edge, a power of two, 16 to 1024")
      ->capture_default_str();
  app.add_option("--samples", settings.samples, "samples per texel: 1, 4, 16 or 64")->capture_default_str();
  app.add_option("--leaf-triangles", arguments.leafTriangles, "a cell of more triangles is split, e.g. 8k")
      ->capture_default_str();
  app.add_option("--max-level", settings.maxLevel, "octree depth limit, 0 to 15")->capture_default_str();
  app.add_option("--fixed-level", settings.fixedLevel, "all leaves at this depth, as in the 2010 paper; -1: adaptive")
      ->capture_default_str();
  app.add_option("--up", arguments.up, "up axis of the model: x, y or z (default: y for .obj, else z)");
  app.add_option("--unit", arguments.unit, "length of a model unit: mm, cm, m, km, in, ft or metres as a number")
      ->capture_default_str();
  app.add_flag("--normals", settings.bakeNormals, "views also keep a normal");
  app.add_option("--threads", arguments.options.threads, "worker threads; 0: all")
      ->check(CLI::Range(0, 1024))
      ->capture_default_str();
  app.add_option(
      "--work-dir", arguments.options.scratchDirectory,
      "directory for scratch files, about 200 bytes a triangle, 300 in a textured model, and 6 a pixel of its "
      "textures (default: where the pack goes)");
  app.add_flag("--json", arguments.json, "print the report as JSON on stdout");
  app.add_flag("--quiet", arguments.quiet, "no progress on stderr");
}

Result<UpAxis> parseUp(const std::string& text, const std::filesystem::path& mesh) {
  if (text == "x") return UpAxis::x;
  if (text == "y") return UpAxis::y;
  if (text == "z") return UpAxis::z;
  if (text.empty()) return mesh.extension() == ".obj" ? UpAxis::y : UpAxis::z;
  return fail(ErrorKind::invalidArgument, "--up: expected x, y or z, found '{}'", text);
}

Result<double> parseUnit(const std::string& text) {
  static const std::map<std::string, double> kUnits = {{"mm", 0.001}, {"cm", 0.01},   {"m", 1},
                                                       {"km", 1000},  {"in", 0.0254}, {"ft", 0.3048}};
  if (const auto unit = kUnits.find(text); unit != kUnits.end()) return unit->second;
  char* end = nullptr;
  const double metres = std::strtod(text.c_str(), &end);
  if (end == text.c_str() || *end != '\0')
    return fail(ErrorKind::invalidArgument, "--unit: expected mm, cm, m, km, in, ft or a number of metres, found '{}'",
                text);
  return metres;
}

void printSummary(const BuildResult& result) {
  const Directory& directory = result.directory;
  const BuildReport& report = directory.report;
  const auto leaves = std::count_if(directory.cells.begin(), directory.cells.end(),
                                    [](const CellRecord& cell) { return cell.childCount == 0; });
  fmt::print(
      "triangles {} (skipped {}), cells {} + {} inner, views {} of {} kept\n", report.inputTriangles,
      [&] {
        uint64_t sum = 0;
        for (const auto& [reason, count] : report.skipped) sum += count;
        return sum;
      }(),
      leaves, directory.cells.size() - static_cast<size_t>(leaves), report.viewsKept, report.viewsBaked);
  fmt::print("pack {:.1f} MB: impostors {:.1f} (raw {:.1f}), geometry {:.1f}; {:.1f} s, peak memory {:.0f} MB\n",
             static_cast<double>(result.packBytes) * 1e-6, static_cast<double>(report.impostorBytes) * 1e-6,
             static_cast<double>(report.impostorRawBytes) * 1e-6, static_cast<double>(report.geometryBytes) * 1e-6,
             result.seconds.total, static_cast<double>(peakRssBytes()) * 1e-6);
}

nlohmann::ordered_json texturesJson(const TextureReport& textures) {
  nlohmann::ordered_json leftOut = nlohmann::ordered_json::array();
  for (const Error& error : textures.leftOut) leftOut.push_back(error.message);
  return {{"read", textures.read}, {"leftOut", leftOut}};
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
  FARCELL_ASSIGN(settings.up, parseUp(arguments.up, arguments.mesh));
  FARCELL_ASSIGN(settings.metresPerUnit, parseUnit(arguments.unit));
  Progress progress(!arguments.quiet);
  FARCELL_ASSIGN(const BuildResult result, buildPack(arguments.mesh, arguments.pack, arguments.options, progress));
  warnOfTextures(result.textures.leftOut);
  if (!arguments.json) {
    printSummary(result);
    return {};
  }
  const StageSeconds& seconds = result.seconds;
  const BuildTimes times{seconds.read, seconds.partition, seconds.lod, seconds.bake, seconds.encode, seconds.total};
  const uint64_t peakRss = peakRssBytes();
  nlohmann::ordered_json report = buildReportJson(result.directory, result.packBytes, &times, &peakRss);
  report["textures"] = texturesJson(result.textures);
  std::fputs(jsonText(report).c_str(), stdout);
  return {};
}

}  // namespace
}  // namespace farcell

int main(int argc, char** argv) {
  CLI::App app("Builds a pack from a mesh file.", "farcell build");
  farcell::Arguments arguments;
  farcell::addOptions(app, arguments);
  return farcell::runProgram(app, argc, argv, [&] { return farcell::run(arguments); });
}
