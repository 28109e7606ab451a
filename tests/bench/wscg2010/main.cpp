// bench_wscg2010: the experiment of the 2010 paper on given models; see measure/experiment.h.
#include <chrono>
#include <cstdio>

#include "tests/bench/wscg2010/measure/report.h"
#include "tools/cli/cli.h"

namespace farcell::wscg {
namespace {

struct Options {
  std::vector<std::filesystem::path> models;
  std::filesystem::path output;
  std::string up = "z";
  bool quick = false;
};

Result<> run(const Options& options) {
  const auto start = std::chrono::steady_clock::now();
  ExperimentSettings settings = options.quick ? quickSettings() : ExperimentSettings{};
  settings.models = options.models;
  settings.output = options.output;
  settings.up = options.up == "x" ? UpAxis::x : options.up == "y" ? UpAxis::y : UpAxis::z;
  FARCELL_ASSIGN(const ExperimentResults results, runExperiment(settings));
  RunFacts facts = machineFacts();
  facts.minutes = std::chrono::duration<double, std::ratio<60>>(std::chrono::steady_clock::now() - start).count();
  facts.quick = options.quick;
  FARCELL_TRY(writeReport(results, settings, facts));
  std::printf("%s\n", (options.output / "results.md").c_str());
  return {};
}

}  // namespace
}  // namespace farcell::wscg

int main(int argc, char** argv) {
  CLI::App app("The experiment of the 2010 paper: errors, frame times, bytes, pictures", "bench_wscg2010");
  farcell::wscg::Options options;
  app.add_option("--model", options.models, "A mesh of at most 8 M triangles; may be given several times")->required();
  app.add_option("-o,--output", options.output, "Directory for results.md, CSV files and pictures")->required();
  app.add_option("--up", options.up, "The models' up axis")
      ->capture_default_str()
      ->check(CLI::IsMember({"x", "y", "z"}));
  app.add_flag("--quick", options.quick, "Small pictures, few cameras: rough figures in seconds");
  return farcell::runProgram(app, argc, argv, [&] { return farcell::wscg::run(options); });
}
