// The command line of farcell-render.
#pragma once

#include <CLI/CLI.hpp>
#include <array>
#include <cstdint>
#include <string>

#include "cache/base/result.h"
#include "runtime/renderer.h"

namespace farcell {

// As typed.
struct RenderOptions {
  std::string pack;
  std::string cameras;     // empty: an overview
  std::string cameraName;  // empty: the first
  std::string size = "1280x720";
  std::string mode = "auto";
  std::string kind = "A";
  std::string triangleBudget = "500k";
  double texelPixels = kTexelPixels;
  int samples = 4;
  std::string background;  // empty: kDefaultBackground
  std::string residentBytes = "1G";
  int repeat = 1;
  std::string output;
  std::string statsFile;  // empty: none; "-": stdout
};

// As meant.
struct RenderPlan {
  RenderSettings settings;
  std::array<uint8_t, 3> background{};
  uint64_t residentBytes = 0;
};

void addRenderOptions(CLI::App& app, RenderOptions& options);
Result<RenderPlan> planOf(const RenderOptions& options);

}  // namespace farcell
