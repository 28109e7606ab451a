// What a pack is lit by, as command lines say it.
#pragma once

#include <CLI/CLI.hpp>
#include <string>

#include "runtime/camera/light.h"

namespace farcell {

// As typed.
struct LightOptions {
  std::string light = "sun";
  std::string sun;  // empty: the pack's own
};

void addLightOptions(CLI::App& app, LightOptions& options);
Result<Light> lightOf(const LightOptions& options);

}  // namespace farcell
