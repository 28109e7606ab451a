// farcell-extract: the views of a pack, or its textures, as pictures.
#include <cstdio>

#include "tools/cli/cli.h"
#include "tools/extract/textures/extract_textures.h"
#include "tools/extract/views/extract.h"
#include "tools/report/build_report_json.h"

namespace farcell {
namespace {

// As typed.
struct ExtractOptions {
  std::string pack;
  std::string cell = "all";
  std::string views = "all";
  std::string channel = "colour";
  std::string format = "png";
  std::string output;
  bool full = false;
  bool atlas = false;
  bool textures = false;
  uint32_t level = 0;
  bool json = false;
};

void addOptions(CLI::App& app, ExtractOptions& options) {
  app.add_option("pack", options.pack, "pack file (.far)")->required();
  app.add_option("--cell", options.cell, "a cell's number, its level/x/y/z, or all that have what is extracted")
      ->type_name("CELL")
      ->capture_default_str();
  auto* views = app.add_option("--views", options.views, "all, or numbers and ranges: 0,7,12-20")
                    ->type_name("LIST")
                    ->capture_default_str();
  auto* channel =
      app.add_option("--channel", options.channel,
                     "colour: with coverage as alpha; depth: 0 unknown, 255 nearest; normal: of relightable packs")
          ->check(CLI::IsMember({"colour", "coverage", "depth", "normal"}))
          ->capture_default_str();
  app.add_option("--format", options.format, "of the pictures")
      ->check(CLI::IsMember({"png", "tif"}))
      ->capture_default_str();
  auto* full =
      app.add_flag("--full", options.full, "the whole square of each view, not only the part that holds anything");
  auto* atlas = app.add_flag("--atlas", options.atlas,
                             "all views of a cell in one picture, with a JSON file that names its tiles");
  auto* textures = app.add_flag("--textures", options.textures,
                                "not views, but the images that the triangles of leaves look at: one for each part of "
                                "131072 triangles of a leaf that has one");
  for (CLI::Option* ofViews : {views, channel, full, atlas}) textures->excludes(ofViews);
  app.add_option(
         "--level", options.level,
         "with --textures: 0 is the finest, each next one has half its edges; the coarsest where it has no such")
      ->check(CLI::Range(0u, kMaxAtlasLevels - 1))
      ->capture_default_str()
      ->needs(textures);
  app.add_flag("--json", options.json, "print what was written as JSON on stdout");
  app.add_option("-o,--output", options.output, "directory to write to; made where it is missing")->required();
}

void printWritten(const ExtractOptions& options, const nlohmann::ordered_json& result) {
  if (options.json) {
    std::printf("%s\n", jsonText(result).c_str());
    return;
  }
  for (const auto& file : result["written"]) std::printf("%s\n", file["file"].get<std::string>().c_str());
}

Result<> runTextures(const ExtractOptions& options) {
  FARCELL_ASSIGN(const PackFile pack, PackFile::open(options.pack));
  TextureExtraction settings;
  settings.cells = cellsWithTextures(pack.directory());
  if (options.cell != "all") {
    FARCELL_ASSIGN(settings.cells, parseCells(options.cell, pack.directory()));
  }
  settings.level = options.level;
  settings.format = options.format;
  settings.directory = options.output;
  FARCELL_ASSIGN(const nlohmann::ordered_json result, extractTextures(pack, settings));
  printWritten(options, result);
  return {};
}

// Of any cell.
uint32_t mostViews(const Directory& directory) {
  int most = 0;
  for (const CellRecord& cell : directory.cells) most = std::max(most, cell.form.views);
  return static_cast<uint32_t>(most);
}

Result<> runViews(const ExtractOptions& options) {
  ExtractSettings settings;
  FARCELL_ASSIGN(settings.channel, parseChannel(options.channel));
  FARCELL_ASSIGN(const PackFile pack, PackFile::open(options.pack));
  const Directory& directory = pack.directory();
  FARCELL_ASSIGN(settings.cells, parseCells(options.cell, directory));
  FARCELL_ASSIGN(settings.views, parseViews(options.views, mostViews(directory)));
  settings.format = options.format;
  settings.full = options.full;
  settings.atlas = options.atlas;
  settings.directory = options.output;
  FARCELL_ASSIGN(const nlohmann::ordered_json result, extractViews(pack, settings));
  printWritten(options, result);
  if (options.json) return {};
  std::fprintf(stderr, "%zu pictures, %llu views hold nothing\n", result["written"].size(),
               static_cast<unsigned long long>(result["empty"].get<uint64_t>()));
  return {};
}

}  // namespace
}  // namespace farcell

int main(int argc, char** argv) {
  CLI::App app(
      "Writes the views of a pack as pictures, or its textures.\n"
      "One picture a view, or one a cell with --atlas; with --textures one a leaf that has an image.",
      "farcell-extract");
  app.footer(
      "Examples:\n"
      "  farcell extract city.far --cell 0 --atlas -o views/\n"
      "  farcell extract city.far --cell 3/1/4/2 --views 0-11 --channel depth --full -o views/\n"
      "  farcell extract spot.far --textures --level 2 -o textures/\n");
  farcell::ExtractOptions options;
  farcell::addOptions(app, options);
  return farcell::runProgram(
      app, argc, argv, [&] { return options.textures ? farcell::runTextures(options) : farcell::runViews(options); });
}
