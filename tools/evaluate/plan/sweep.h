// Settings against each other in one run: every renderer that has them, with each combination of their values.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "cache/base/result.h"
#include "tools/evaluate/plan/renderers.h"

namespace farcell {

inline constexpr size_t kMaxRenderers = 64;  // of a run with a sweep
inline constexpr double kLeastTexelPixels = 0.01, kMostTexelPixels = 100;
inline constexpr double kLeastMeshPixels = 0.01, kMostMeshPixels = 100;  // and 0: no simplified meshes
inline constexpr double kMostTimeBudgetMs = 1e6;                         // 0: no time budget

// sweeps: "texel-pixels=0.25,0.5", "mesh-pixels=0,1,4", "triangle-budget=100k,2M", "time-budget-ms=0,16"; values as the
// options of these names take them, repetitions count once. In the place of each plan that has swept settings stand its
// variants, the last setting varying fastest: "auto@texel-pixels=0.25@triangle-budget=100k". The baselines have no such
// setting and stay as they are. invalidArgument: an unknown setting, one swept twice or that no plan has; a value its
// option would not take; more than kMaxRenderers.
Result<std::vector<RendererPlan>> sweepRenderers(std::vector<RendererPlan> plans, std::span<const std::string> sweeps);

}  // namespace farcell
