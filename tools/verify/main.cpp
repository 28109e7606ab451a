// farcell-verify: checks every byte of a pack. Findings go to stderr, a line each; exit code 1 when there are any.
#include <cstdio>

#include "cache/base/interrupt.h"
#include "cache/base/progress.h"
#include "cache/pack/pack_file.h"
#include "tools/cli/cli.h"
#include "tools/report/build_report_json.h"

namespace farcell {
namespace {

struct Outcome {
  std::vector<Error> findings;
  uint64_t pages = 0;
  uint64_t sizeBytes = 0;
};

// A pack that cannot be opened is a finding; a file that cannot be read is an error.
Result<Outcome> verified(const std::string& path, size_t maxFindings, ProgressForm form) {
  Outcome outcome;
  const Result<PackFile> pack = PackFile::open(path);
  if (!pack) {
    if (pack.error().kind != ErrorKind::corrupt) return tl::unexpected<Error>(pack.error());
    outcome.findings.push_back(pack.error());
    return outcome;
  }
  outcome.pages = pack->directory().pages.size();
  outcome.sizeBytes = pack->sizeBytes();
  Progress progress(form);
  progress.begin("verify", outcome.pages, "pages");
  outcome.findings = pack->verify(maxFindings, [&](uint64_t) { progress.advance(); });
  progress.end();
  FARCELL_TRY(checkInterrupt());
  return outcome;
}

std::string outcomeJson(const std::string& path, const Outcome& outcome) {
  nlohmann::ordered_json findings = nlohmann::ordered_json::array();
  for (const Error& finding : outcome.findings) findings.push_back(finding.message);
  return jsonText({{"path", path},
                   {"valid", outcome.findings.empty()},
                   {"pages", outcome.pages},
                   {"bytes", outcome.sizeBytes},
                   {"findings", findings}});
}

Result<> run(const std::string& path, size_t maxFindings, bool asJson, ProgressForm form) {
  FARCELL_ASSIGN(const Outcome outcome, verified(path, maxFindings, form));
  for (const Error& finding : outcome.findings) std::fprintf(stderr, "%s\n", finding.message.c_str());
  if (asJson) std::printf("%s\n", outcomeJson(path, outcome).c_str());
  if (!outcome.findings.empty())
    return fail(ErrorKind::corrupt, "{}: not a valid pack ({} findings)", path, outcome.findings.size());
  if (!asJson)
    std::printf("%s: valid, %llu pages, %llu bytes\n", path.c_str(), static_cast<unsigned long long>(outcome.pages),
                static_cast<unsigned long long>(outcome.sizeBytes));
  return {};
}

}  // namespace
}  // namespace farcell

int main(int argc, char** argv) {
  CLI::App app(
      "Checks every byte of a pack.\n"
      "Findings go to stderr, a line each, with the place in the file; the exit code is 1 when there are any.",
      "farcell-verify");
  app.footer(
      "Examples:\n"
      "  farcell verify city.far\n"
      "  farcell verify city.far --json --max-findings 1\n");
  std::string path;
  size_t maxFindings = 100;
  bool asJson = false;
  app.add_option("pack", path, "pack file (.far)")->required();
  app.add_option("--max-findings", maxFindings, "stop after this many findings")
      ->check(CLI::Range(1, 1'000'000))
      ->capture_default_str();
  app.add_flag("--json", asJson, "print JSON on stdout");
  farcell::ProgressForm progress = farcell::ProgressForm::automatic;
  farcell::addProgressOption(app, progress);
  return farcell::runProgram(app, argc, argv, [&] { return farcell::run(path, maxFindings, asJson, progress); });
}
