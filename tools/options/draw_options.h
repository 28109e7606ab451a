// How a pack is drawn, as the command lines of render and view say it.
#pragma once

#include <CLI/CLI.hpp>
#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "cache/base/result.h"
#include "cache/schema/model.h"
#include "runtime/renderer.h"
#include "tools/options/light_options.h"

namespace farcell {

// Words of --samples, one of which stands for RenderSettings::samplesPerPixel.
inline const std::vector<std::string> kSampleWords = {"auto", "1", "4", "8", "16", "64"};
// The least with which near triangles have .4 of the error of 1, and prefiltered impostors .27 (tests/bench/near).
inline constexpr const char* kSamples = "8";
int samplesNamed(const std::string& word);  // REQUIRES: one of these
std::string samplesText(int samplesPerPixel);

// As typed.
struct DrawOptions {
  std::string pack;
  std::string cameras;     // empty: an overview
  std::string cameraName;  // empty: the first
  std::string size = "1280x720";
  std::string mode = "auto";
  std::string kind = "A";
  std::string show = "picture";
  std::string triangleBudget = "1M";
  double timeBudgetMs = 0;
  bool recalibrate = false;
  std::string occlusion = "off";
  double texelPixels = kTexelPixels;
  double meshPixels = kMeshPixels;
  std::string samples = kSamples;
  LightOptions light;
  std::string background;  // empty: the program's own
  std::string residentBytes = "1G";
};

// As meant.
struct DrawPlan {
  RenderSettings settings;
  std::optional<std::array<uint8_t, 3>> background;
  uint64_t residentBytes = 0;
  bool recalibrate = false;
};

// `background` says what the program draws behind the model unless told otherwise.
void addDrawOptions(CLI::App& app, DrawOptions& options, const std::string& background);
Result<DrawPlan> planOf(const DrawOptions& options);

// Where a time budget is given, or `recalibrate`: what drawing costs on this machine, in place of the default.
Result<> applyMachineCosts(GlContext& context, bool recalibrate, RenderSettings& settings);

// The camera asked for, or an overview of the model in a picture of that shape.
Result<Camera> chooseCamera(const DrawOptions& options, const Model& model, int width, int height);

// As the options spell them.
const char* modeName(RenderMode mode);
const char* kindName(ImpostorKind kind);
const char* showName(Show show);

}  // namespace farcell
