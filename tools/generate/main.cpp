// farcell-generate: models to try the other programs on.
#include <chrono>
#include <cstdio>

#include "tools/cli/cli.h"
#include "tools/generate/verbs.h"

namespace farcell {
namespace {

template <class Options>
Result<> generate(const Options& options, Result<nlohmann::ordered_json> (*make)(const Options&)) {
  const auto start = std::chrono::steady_clock::now();
  FARCELL_ASSIGN(nlohmann::ordered_json counts, make(options));
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  if (options.json) {
    counts["seconds"] = seconds;
    std::printf("%s\n", counts.dump(2).c_str());
  } else {
    std::printf("%s",
                fmt::format("{}: {} triangles, {} vertices, {} bytes, {:.1f} s\n", options.output,
                            counts["triangles"].template get<uint64_t>(), counts["vertices"].template get<uint64_t>(),
                            counts["bytes"].template get<uint64_t>(), seconds)
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
  farcell::GenerateOptions cityOptions;
  farcell::StatueOptions statueOptions;
  const CLI::App* city = farcell::addCityVerb(app, cityOptions);
  farcell::addStatueVerb(app, statueOptions);
  app.require_subcommand(1);
  return farcell::runProgram(app, argc, argv, [&] {
    return city->parsed() ? farcell::generate(cityOptions, farcell::generateCity)
                          : farcell::generate(statueOptions, farcell::generateStatue);
  });
}
