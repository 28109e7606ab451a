#include "tools/generate/verbs.h"

#include "datasets/city/city.h"
#include "datasets/statue/statue.h"
#include "preprocess/mesh/vertices.h"
#include "preprocess/read/open_mesh.h"
#include "tools/cli/cli.h"

namespace farcell {
namespace {

std::array<uint8_t, 3> channels(uint32_t colour) {
  return {static_cast<uint8_t>(colour), static_cast<uint8_t>(colour >> 8), static_cast<uint8_t>(colour >> 16)};
}

// The mesh in memory; a model without colours is of the usual stone.
Result<BaseMesh> readBase(const std::string& path) {
  FARCELL_ASSIGN(const std::unique_ptr<MeshReader> reader, openMesh(path));
  const bool hasColours = reader->info().hasColours;
  BaseMeshBuilder builder;
  FARCELL_TRY(reader->forEachTriangle([&](std::span<const InputTriangle> batch) -> Result<> {
    for (const InputTriangle& triangle : batch) {
      std::array<std::array<uint8_t, 3>, 3> colours;
      for (size_t i = 0; i < 3; ++i) colours[i] = channels(hasColours ? triangle.colours[i] : defaultColour());
      FARCELL_TRY(builder.add(triangle.positions, colours));
    }
    return {};
  }));
  auto base = std::move(builder).finish();
  if (!base) return fail(base.error().kind, "{}: {}", path, base.error().message);
  return base;
}

}  // namespace

void addSharedOptions(CLI::App& verb, GenerateOptions& options) {
  verb.add_option("--threads", options.threads, "worker threads; 0: all")
      ->capture_default_str()
      ->check(CLI::Range(0, 1024));
  verb.add_option("-o,--output", options.output, "mesh file to write (.ply)")->required();
  verb.add_flag("--json", options.json, "print counts as JSON on stdout");
  addProgressOption(verb, options.progress);
}

CLI::App* addCityVerb(CLI::App& app, GenerateOptions& options) {
  CLI::App* city = app.add_subcommand("city", "A procedural city, as binary PLY.");
  city->add_option("--triangles", options.triangles, "how many, e.g. 500k, 5M, 1G; at least 2k; within 5 % from 10k on")
      ->type_name("COUNT")
      ->capture_default_str();
  city->add_option("--seed", options.seed, "another number, another city")->capture_default_str();
  addSharedOptions(*city, options);
  city->footer(
      "Examples:\n"
      "  farcell generate city --triangles 2M --seed 7 -o city.ply\n");
  return city;
}

CLI::App* addStatueVerb(CLI::App& app, StatueOptions& options) {
  const StatueSettings defaults;
  options.amplitude = defaults.amplitude;
  options.roughness = defaults.roughness;
  CLI::App* statue = app.add_subcommand("statue", "A fractal statue, or a scan made finer, as binary PLY.");
  statue
      ->add_option("--triangles", options.triangles,
                   "how many, e.g. 500k, 5M, 1G; within 5 %; at least 5k, or the mesh's")
      ->type_name("COUNT")
      ->capture_default_str();
  statue->add_option("--from", options.from, "mesh file to make finer; without it: a figure of our own");
  statue->add_option("--amplitude", options.amplitude, "most that the relief stands out, in diagonals of the model")
      ->capture_default_str()
      ->check(CLI::Range(0.0, 0.1));
  statue->add_option("--roughness", options.roughness, "height of each finer layer of relief against the one before")
      ->capture_default_str()
      ->check(CLI::Range(0.0, 0.9));
  statue->add_option("--seed", options.seed, "another number, another relief and face")->capture_default_str();
  addSharedOptions(*statue, options);
  statue->footer(
      "Examples:\n"
      "  farcell generate statue --triangles 2M -o statue.ply\n"
      "  farcell generate statue --from scan.obj --triangles 20M -o fine.ply\n");
  return statue;
}

Result<nlohmann::ordered_json> generateCity(const GenerateOptions& options) {
  CitySettings settings;
  FARCELL_ASSIGN(settings.triangles, parseCount(options.triangles));
  settings.seed = options.seed;
  settings.threads = options.threads;
  Progress progress(options.progress);
  FARCELL_ASSIGN(const CityCounts counts, writeCity(settings, options.output, progress));
  return nlohmann::ordered_json{
      {"triangles", counts.triangles}, {"vertices", counts.vertices}, {"bytes", counts.bytes}};
}

Result<nlohmann::ordered_json> generateStatue(const StatueOptions& options) {
  StatueSettings settings;
  FARCELL_ASSIGN(settings.triangles, parseCount(options.triangles));
  settings.seed = options.seed;
  settings.threads = options.threads;
  settings.amplitude = options.amplitude;
  settings.roughness = options.roughness;
  FARCELL_ASSIGN(const BaseMesh base, options.from.empty() ? makeFigure(settings) : readBase(options.from));
  Progress progress(options.progress);
  FARCELL_ASSIGN(const StatueCounts counts, writeStatue(base, settings, options.output, progress));
  return nlohmann::ordered_json{{"triangles", counts.triangles},
                                {"vertices", counts.vertices},
                                {"bytes", counts.bytes},
                                {"baseTriangles", counts.baseTriangles}};
}

}  // namespace farcell
