// farcell batch: the packs of a list of data sets.
#include <cstdio>

#include "cache/base/interrupt.h"
#include "tools/batch/batch.h"
#include "tools/cli/cli.h"
#include "tools/report/build_report_json.h"

namespace farcell {
namespace {

std::string lineOf(const DataSetResult& result) {
  std::string line = fmt::format("{:<24} {}", result.name, nameOf(result.outcome));
  if (result.outcome != Outcome::failed)
    line += fmt::format(", {} triangles, pack {}", result.triangles, bytesText(result.packBytes));
  if (result.seconds > 0)
    line += fmt::format(", {}, memory {}", durationText(result.seconds), bytesText(result.peakRssBytes));
  if (!result.message.empty()) line += fmt::format(": {}", result.message);
  return line;
}

nlohmann::ordered_json jsonOf(const DataSetResult& result) {
  return {{"name", result.name},       {"outcome", nameOf(result.outcome)}, {"triangles", result.triangles},
          {"seconds", result.seconds}, {"packBytes", result.packBytes},     {"peakRssBytes", result.peakRssBytes},
          {"message", result.message}};
}

Result<> run(const BatchOptions& options, bool asJson) {
  FARCELL_ASSIGN(const std::vector<DataSetResult> results, runBatch(options, [&](const DataSetResult& result) {
                   if (asJson) return;
                   std::printf("%s\n", lineOf(result).c_str());
                   std::fflush(stdout);
                 }));
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  size_t failed = 0;
  for (const DataSetResult& result : results) {
    list.push_back(jsonOf(result));
    failed += result.outcome == Outcome::failed ? 1 : 0;
  }
  if (asJson) std::printf("%s\n", jsonText({{"datasets", list}}).c_str());
  FARCELL_TRY(checkInterrupt());
  if (failed > 0) return fail(ErrorKind::io, "{} of {} data sets failed", failed, results.size());
  return {};
}

}  // namespace
}  // namespace farcell

int main(int argc, char** argv) {
  CLI::App app(
      "Builds the packs of a list of data sets.\n"
      "Each is built by `farcell build` on its own; one that fails is told and the next begins. A data set whose pack "
      "is there, built from the same files with the same options, is not built again: <name>.json beside the pack "
      "keeps what it was built from. After Ctrl-C the same command goes on where it was.",
      "farcell-batch");
  app.footer(
      "Examples:\n"
      "  farcell batch datasets.json -o packs/\n"
      "  farcell batch datasets.json -o packs/ --stop-on-failure --json > report.json\n"
      "Files:\n"
      "  datasets.json   {\"datasets\": [{\"name\": \"city\", \"meshes\": [\"city.ply\"],\n"
      "                    \"output\": \"city.far\", \"options\": {\"views\": 42, \"unit\": \"m\"}}]}\n"
      "                  paths are relative to the file; output: <name>.far when absent;\n"
      "                  options: the long ones of `farcell build`; true for a flag\n");
  farcell::BatchOptions options;
  bool asJson = false;
  app.add_option("list", options.list, "file of data sets (JSON)")->required();
  app.add_option("-o,--output", options.output, "directory of the packs, made when absent")
      ->required()
      ->type_name("DIR");
  app.add_option("--jobs", options.jobs, "builds at a time; each takes threads and memory of its own")
      ->check(CLI::Range(1, 256))
      ->capture_default_str();
  app.add_flag("--stop-on-failure", options.stopOnFailure, "begin no other build after one has failed");
  app.add_flag("--json", asJson, "print the results as JSON on stdout, at the end");
  farcell::addProgressOption(app, options.progress);
  return farcell::runProgram(app, argc, argv, [&] { return farcell::run(options, asJson); });
}
