// The models farcell-generate can make: each adds its options to the command line and makes one model.
#pragma once

#include <CLI/CLI.hpp>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>

#include "cache/base/progress.h"
#include "cache/base/result.h"

namespace farcell {

// As typed; what every model has.
struct GenerateOptions {
  std::string triangles = "5M";
  uint64_t seed = 1;
  int threads = 0;
  std::string output;
  bool json = false;
  ProgressForm progress = ProgressForm::automatic;
};

struct StatueOptions : GenerateOptions {
  std::string from;  // empty: the figure of our own
  double amplitude = 0;
  double roughness = 0;
};

CLI::App* addCityVerb(CLI::App& app, GenerateOptions& options);
CLI::App* addStatueVerb(CLI::App& app, StatueOptions& options);

// Counts of what was written: triangles, vertices, bytes and what else is known.
Result<nlohmann::ordered_json> generateCity(const GenerateOptions& options);
Result<nlohmann::ordered_json> generateStatue(const StatueOptions& options);

// --seed, --threads, --output, --json, --progress.
void addSharedOptions(CLI::App& verb, GenerateOptions& options);

}  // namespace farcell
