#include "tools/evaluate/plan/renderers.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>
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
  bool always;  // of the pack evaluated
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
    // Its mode has none of the settings of selection.
    Known{kOctahedral, "impostor", RenderMode::full, 1, ImpostorKind::flat, false},
    Known{kLodAsAuto, "geometry", RenderMode::meshes, 4, ImpostorKind::depthCorrected, false},
};

// A name as it is asked for: "flat@paper" is {"flat", "paper"}.
struct Asked {
  std::string renderer, pack;
};

Result<Asked> parseName(const std::string& name, std::span<const std::string> packs) {
  const size_t at = name.find('@');
  Asked asked{name.substr(0, at), at == std::string::npos ? "" : name.substr(at + 1)};
  if (std::none_of(kKnown.begin(), kKnown.end(), [&](const Known& known) { return known.name == asked.renderer; }))
    return fail(ErrorKind::invalidArgument, "renderers: expected some of {},{},{}, found '{}'", kAllRenderers,
                kOctahedral, kLodAsAuto, name);
  if (at != std::string::npos && std::find(packs.begin(), packs.end(), asked.pack) == packs.end())
    return fail(ErrorKind::invalidArgument, "renderers: '{}': no pack '{}' is given with --against", name, asked.pack);
  if (at != std::string::npos && (asked.renderer == kLodAsAuto || asked.renderer == kOctahedral))
    return fail(ErrorKind::invalidArgument, "renderers: '{}': only of the pack itself", name);
  return asked;
}

// The renderers asked for of each pack.
using Names = std::map<std::string, std::set<std::string>>;

Result<Names> parseNames(const std::string& names, std::span<const std::string> packs) {
  Names asked;
  std::istringstream stream(names);
  for (std::string name; std::getline(stream, name, ',');) {
    FARCELL_ASSIGN(Asked one, parseName(name, packs));
    asked[one.pack].insert(std::move(one.renderer));
  }
  if (asked[""].contains(kLodAsAuto) && !asked[""].contains("auto"))
    return fail(ErrorKind::invalidArgument, "renderers: {} needs auto, whose time it takes", kLodAsAuto);
  return asked;
}

}  // namespace

bool usesTexelPixels(RenderMode mode) { return mode == RenderMode::automatic || mode == RenderMode::impostors; }
bool usesMeshPixels(RenderMode mode) { return mode == RenderMode::automatic || mode == RenderMode::meshes; }
bool usesTriangleBudget(RenderMode mode) { return mode == RenderMode::automatic; }
bool usesTimeBudget(RenderMode mode) { return mode == RenderMode::automatic; }

Result<std::vector<RendererPlan>> planRenderers(const std::string& names, int width, int height,
                                                const SelectionSettings& selection, double lodPixels,
                                                std::span<const std::string> packs) {
  FARCELL_ASSIGN(Names asked, parseNames(names, packs));
  std::vector<std::string> order = {""};
  order.insert(order.end(), packs.begin(), packs.end());
  std::vector<RendererPlan> plans;
  for (const std::string& pack : order)
    for (const Known& known : kKnown) {
      if (!(known.always && pack.empty()) && !asked[pack].contains(known.name)) continue;
      RendererPlan& plan = plans.emplace_back();
      plan.name = plan.kind = pack.empty() ? known.name : fmt::format("{}@{}", known.name, pack);
      plan.rendererClass = known.rendererClass;
      plan.pack = pack;
      plan.timeOf = plan.name == kLodAsAuto ? "auto" : "";
      plan.settings.width = width;
      plan.settings.height = height;
      plan.settings.samplesPerPixel = known.samplesPerPixel;
      plan.settings.kind = known.kind;
      plan.settings.selection = selection;
      plan.settings.selection.mode = known.mode;
      if (known.mode == RenderMode::meshes) plan.settings.selection.meshPixels = lodPixels;
    }
  return plans;
}

}  // namespace farcell
