// What a report says of each renderer over all cameras.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "tools/evaluate/report/entry.h"

namespace farcell {

// Over some of the cameras: those that have a ratio.
struct RatioSummary {
  size_t cameras = 0;
  std::optional<double> ratioToFull1spp;  // geometric mean; nothing without cameras
  std::optional<double> worstRatio;
};

inline constexpr double kMostlyImpostors = 0.8;  // impostorShare from which a camera's picture counts as impostors

struct RendererSummary {
  std::string renderer;
  std::string rendererClass;
  std::string kind;  // RendererPlan::kind
  RatioSummary all;
  RatioSummary mostlyImpostors;  // entries with impostorShare >= kMostlyImpostors
  RatioSummary elsewhere;
  double medianFrameMs = 0;    // median over cameras of the medians
  double medianTriangles = 0;  // over cameras
  double medianBytesRead = 0;  // over cameras, of the cold frame
  double worstHoleRate = 0;
  double meanFlip = 0;  // over cameras
  // Pareto fronts of all.ratioToFull1spp and medianFrameMs or medianBytesRead, of all renderers or of those of its
  // kind; false without a ratio.
  bool onParetoFront = false, onKindFront = false;
  bool onBytesFront = false, onKindBytesFront = false;
};

// Sets each entry's ratio from the baseline entry of the same camera. REQUIRES: no two cameras of one name.
void setRatios(std::vector<Entry>& entries);

// In order of first occurrence. Entries must have their ratios.
std::vector<RendererSummary> summarise(std::span<const Entry> entries);

}  // namespace farcell
