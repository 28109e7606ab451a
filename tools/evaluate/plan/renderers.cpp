#include "tools/evaluate/plan/renderers.h"

#include <algorithm>
#include <array>
#include <set>
#include <sstream>

namespace farcell {
namespace {

struct Known {
  const char* name;
  const char* rendererClass;
  RenderMode mode;
  int samplesPerPixel;
  ImpostorKind kind;
  bool always;
};
constexpr std::array kKnown = {
    Known{kBaselineRenderer, "geometry", RenderMode::full, 1, ImpostorKind::depthCorrected, true},
    Known{kSupersampledRenderer, "geometry", RenderMode::full, 4, ImpostorKind::depthCorrected, true},
    Known{"full-16spp", "geometry", RenderMode::full, 16, ImpostorKind::depthCorrected, false},
    Known{"triangles", "geometry", RenderMode::triangles, 4, ImpostorKind::depthCorrected, false},
    Known{"lod", "geometry", RenderMode::meshes, 4, ImpostorKind::depthCorrected, false},
    Known{"flat", "impostor", RenderMode::impostors, 4, ImpostorKind::flat, false},
    Known{"A", "impostor", RenderMode::impostors, 4, ImpostorKind::depthCorrected, false},
    Known{"B", "impostor", RenderMode::impostors, 4, ImpostorKind::blended, false},
    Known{"auto", "mixed", RenderMode::automatic, 4, ImpostorKind::depthCorrected, false},
    Known{"auto-B", "mixed", RenderMode::automatic, 4, ImpostorKind::blended, false},
};

Result<std::set<std::string>> parseNames(const std::string& names) {
  std::set<std::string> asked;
  std::istringstream stream(names);
  for (std::string name; std::getline(stream, name, ',');) {
    if (std::none_of(kKnown.begin(), kKnown.end(), [&](const Known& known) { return known.name == name; }))
      return fail(ErrorKind::invalidArgument, "renderers: expected some of {}, found '{}'", kAllRenderers, name);
    asked.insert(name);
  }
  return asked;
}

}  // namespace

bool usesTexelPixels(RenderMode mode) { return mode == RenderMode::automatic || mode == RenderMode::impostors; }
bool usesTriangleBudget(RenderMode mode) { return mode == RenderMode::automatic; }

Result<std::vector<RendererPlan>> planRenderers(const std::string& names, int width, int height,
                                                const SelectionSettings& selection, double lodPixels) {
  FARCELL_ASSIGN(const std::set<std::string> asked, parseNames(names));
  std::vector<RendererPlan> plans;
  for (const Known& known : kKnown) {
    if (!known.always && !asked.contains(known.name)) continue;
    RenderSettings settings;
    settings.width = width;
    settings.height = height;
    settings.samplesPerPixel = known.samplesPerPixel;
    settings.kind = known.kind;
    settings.selection = selection;
    settings.selection.mode = known.mode;
    if (known.mode == RenderMode::meshes) settings.selection.meshPixels = lodPixels;
    plans.push_back({known.name, known.rendererClass, settings});
  }
  return plans;
}

}  // namespace farcell
