// The renderers a report can compare, by the names its contract gives them.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "cache/base/result.h"
#include "runtime/renderer.h"

namespace farcell {

struct RendererPlan {
  std::string name;
  std::string rendererClass;  // geometry, impostor or mixed
  RenderSettings settings;
};

inline constexpr const char* kBaselineRenderer = "full-1spp";  // what ratios are relative to
inline constexpr const char* kSupersampledRenderer = "full-4spp";
inline constexpr double kLodPixels = 1;  // as viewers of mesh hierarchies have it
inline constexpr const char* kAllRenderers = "full-1spp,full-4spp,full-16spp,triangles,lod,flat,A,B,auto,auto-B";

// Whether what a mode draws depends on the setting.
bool usesTexelPixels(RenderMode mode);
bool usesTriangleBudget(RenderMode mode);

// names: comma-separated, any order, repetitions allowed. full-1spp and full-4spp always come first: full geometry is
// what the user would otherwise look at. invalidArgument for an unknown name.
// The level rule and the budget are `selection`'s; its mode is the renderer's own, and lod's meshes have an error of at
// most lodPixels.
Result<std::vector<RendererPlan>> planRenderers(const std::string& names, int width, int height,
                                                const SelectionSettings& selection, double lodPixels = kLodPixels);

}  // namespace farcell
