// farcell-generate: models to try the other programs on.
#include <chrono>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "datasets/city/city.h"
#include "tools/cli/cli.h"

namespace farcell {
namespace {

struct CityOptions {
  std::string triangles = "5M";
  uint64_t seed = 1;
  int threads = 0;
  std::string output;
  bool json = false;
};

CLI::App* addCityVerb(CLI::App& app, CityOptions& options) {
  CLI::App* city = app.add_subcommand("city", "A procedural city, as binary PLY.");
  city->add_option("--triangles", options.triangles, "how many, e.g. 500k, 5M, 1G; at least 2k; within 5 % from 10k on")
      ->type_name("COUNT")
      ->capture_default_str();
  city->add_option("--seed", options.seed, "another number, another city")->capture_default_str();
  city->add_option("--threads", options.threads, "worker threads; 0: all")
      ->capture_default_str()
      ->check(CLI::Range(0, 1024));
  city->add_option("-o,--output", options.output, "mesh file to write (.ply)")->required();
  city->add_flag("--json", options.json, "print counts as JSON on stdout");
  city->footer(
      "Examples:\n"
      "  farcell generate city --triangles 2M --seed 7 -o city.ply\n");
  return city;
}

Result<> generateCity(const CityOptions& options) {
  CitySettings settings;
  FARCELL_ASSIGN(settings.triangles, parseCount(options.triangles));
  settings.seed = options.seed;
  settings.threads = options.threads;
  Progress progress(true);
  const auto start = std::chrono::steady_clock::now();
  FARCELL_ASSIGN(const CityCounts counts, writeCity(settings, options.output, progress));
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  if (options.json) {
    const nlohmann::ordered_json report = {
        {"triangles", counts.triangles}, {"vertices", counts.vertices}, {"bytes", counts.bytes}, {"seconds", seconds}};
    std::printf("%s\n", report.dump(2).c_str());
  } else {
    std::printf("%s", fmt::format("{}: {} triangles, {} vertices, {} bytes, {:.1f} s\n", options.output,
                                  counts.triangles, counts.vertices, counts.bytes, seconds)
                          .c_str());
  }
  return {};
}

}  // namespace
}  // namespace farcell

int main(int argc, char** argv) {
  CLI::App app(
      "Makes models to try the other programs on.\n"
      "The same options give the same bytes, with any number of threads.",
      "farcell-generate");
  farcell::CityOptions cityOptions;
  const CLI::App* city = farcell::addCityVerb(app, cityOptions);
  app.require_subcommand(1);
  return farcell::runProgram(app, argc, argv, [&]() -> farcell::Result<> {
    if (city->parsed()) return farcell::generateCity(cityOptions);
    return {};
  });
}
