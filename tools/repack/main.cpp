// farcell-repack: a pack in fewer bytes, for time.
#include <cstdio>

#include "cache/base/parallel.h"
#include "tools/cli/cli.h"
#include "tools/repack/recode/recode.h"
#include "tools/report/build_report_json.h"

namespace farcell {
namespace {

// As typed.
struct RepackOptions {
  std::string pack;
  std::string output;
  int threads = 0;
  bool json = false;
  ProgressForm progress = ProgressForm::automatic;
};

void addOptions(CLI::App& app, RepackOptions& options) {
  app.add_option("pack", options.pack, "pack file (.far)")->required();
  app.add_option("-o,--output", options.output, "pack file to write (.far); may be the one that is read")->required();
  app.add_option("--threads", options.threads, "worker threads; 0: all")
      ->check(CLI::Range(0, kMaxThreads))
      ->capture_default_str();
  app.add_flag("--json", options.json, "print the report as JSON on stdout");
  addProgressOption(app, options.progress);
}

nlohmann::ordered_json bytesJson(const PackBytes& bytes) {
  return {
      {"pack", bytes.pack}, {"impostors", bytes.impostors}, {"geometry", bytes.geometry}, {"textures", bytes.textures}};
}

std::string changeText(const char* what, uint64_t before, uint64_t after) {
  const double change = before == 0 ? 0.0 : 100.0 * (static_cast<double>(after) / static_cast<double>(before) - 1.0);
  return fmt::format("{:<10} {:>14} bytes {:>14} bytes {:>+6.1f} %\n", what, before, after, change);
}

Result<> run(const RepackOptions& options) {
  FARCELL_ASSIGN(const PackFile pack, PackFile::open(options.pack));
  Progress progress(options.progress);
  FARCELL_ASSIGN(const RecodeResult result, recodePack(pack, options.output, options.threads, progress));
  if (options.json) {
    std::printf("%s\n", jsonText({{"input", options.pack},
                                  {"output", options.output},
                                  {"pages", result.pages},
                                  {"bytesBefore", bytesJson(result.before)},
                                  {"bytes", bytesJson(result.after)}})
                            .c_str());
    return {};
  }
  std::fputs(changeText("impostors", result.before.impostors, result.after.impostors).c_str(), stdout);
  std::fputs(changeText("geometry", result.before.geometry, result.after.geometry).c_str(), stdout);
  if (result.before.textures > 0)
    std::fputs(changeText("textures", result.before.textures, result.after.textures).c_str(), stdout);
  std::fputs(changeText("pack", result.before.pack, result.after.pack).c_str(), stdout);
  return {};
}

}  // namespace
}  // namespace farcell

int main(int argc, char** argv) {
  CLI::App app(
      "Writes a pack again in fewer bytes.\n"
      "Every page is coded anew with more patience than a build has: slowly, on all cores, once for packs that are "
      "kept or sent. Nothing is lost: each page is decoded and compared before it is written, and is read as fast as "
      "before.",
      "farcell-repack");
  app.footer(
      "Examples:\n"
      "  farcell repack city.far -o city-small.far\n"
      "  farcell repack city.far -o city.far --progress none --json\n");
  farcell::RepackOptions options;
  farcell::addOptions(app, options);
  return farcell::runProgram(app, argc, argv, [&] { return farcell::run(options); });
}
