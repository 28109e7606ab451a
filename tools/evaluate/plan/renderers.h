// The renderers a report can compare, by the names its contract gives them.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "cache/base/result.h"
#include "runtime/renderer.h"

namespace farcell {

struct RendererPlan {
  std::string name;
  std::string rendererClass;  // geometry, impostor or mixed
  RenderSettings settings;
  std::string kind;    // the name without values of a sweep: what variants have in common
  std::string pack;    // of another pack than the one evaluated: its name; else empty
  int frameEdge = 0;   // of kOctahedral: texels of its frames, once they are known
  std::string timeOf;  // its meshPixels is searched so that a frame takes as long as one of this renderer; else empty
};

inline constexpr const char* kBaselineRenderer = "full-1spp";  // what ratios are relative to
inline constexpr const char* kSupersampledRenderer = "full-4spp";
inline constexpr double kLodPixels = 1;  // as viewers of mesh hierarchies have it
inline constexpr const char* kAllRenderers = "full-1spp,full-4spp,full-16spp,triangles,lod,flat,A,B,auto,auto-B";
// An octahedral impostor of the whole model (baselines/octahedral.h), in as much memory as auto needs.
inline constexpr const char* kOctahedral = "octahedral";
inline constexpr const char* kLodAsAuto = "lod-as-auto";  // meshes only, in the time that auto takes

// Whether what a mode draws depends on the setting.
bool usesTexelPixels(RenderMode mode);
bool usesMeshPixels(RenderMode mode);
bool usesTriangleBudget(RenderMode mode);
bool usesTimeBudget(RenderMode mode);

// names: comma-separated, any order, repetitions allowed: those of kAllRenderers, kOctahedral, and kLodAsAuto, which
// needs auto; with
// "@NAME" one of the first is one of another pack, NAME one of `packs`. full-1spp and full-4spp of the pack itself
// always come first: full geometry is what the user would otherwise look at. invalidArgument for an unknown name. The
// level rule and the budget are `selection`'s; its mode is the renderer's own, and lod's meshes have an error of at
// most lodPixels.
Result<std::vector<RendererPlan>> planRenderers(const std::string& names, int width, int height,
                                                const SelectionSettings& selection, double lodPixels = kLodPixels,
                                                std::span<const std::string> packs = {});

}  // namespace farcell
