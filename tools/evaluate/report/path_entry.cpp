#include "tools/evaluate/report/path_entry.h"

#include <algorithm>
#include <cmath>

#include "tools/evaluate/report/entry.h"

namespace farcell {
namespace {

double meanOf(const std::vector<double>& values) {
  double sum = 0;
  for (const double value : values) sum += value;
  return values.empty() ? 0 : sum / static_cast<double>(values.size());
}

// Nearest rank.
double p99Of(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return values[static_cast<size_t>(std::ceil(0.99 * static_cast<double>(values.size()))) - 1];
}

std::optional<double> knownMean(const std::vector<double>& values) {
  return values.empty() ? std::nullopt : std::optional(meanOf(values));
}

}  // namespace

PathSummary summarise(const PathRun& run) {
  PathSummary summary;
  std::vector<double> flicker, own, reference, atSwitches, elsewhere, ms;
  for (size_t i = 0; i < run.frames.size(); ++i) {
    const PathFrame& frame = run.frames[i];
    summary.meanError += frame.paperError / static_cast<double>(run.frames.size());
    if (i == 0) continue;
    flicker.push_back(frame.change.flicker);
    own.push_back(frame.change.own);
    reference.push_back(frame.change.reference);
    ms.push_back(frame.wallMs);
    const bool switches = frame.viewSwitches + frame.levelSwitches > 0;
    (switches ? atSwitches : elsewhere).push_back(frame.change.flicker);
    summary.viewSwitches += frame.viewSwitches;
    summary.levelSwitches += frame.levelSwitches;
    if (flicker.size() == 1 || frame.change.flicker > summary.worstFlicker) {
      summary.worstFlicker = frame.change.flicker;
      summary.worstFrame = i;
    }
  }
  if (flicker.empty()) return summary;
  summary.frames = flicker.size();
  summary.meanFlicker = meanOf(flicker);
  summary.p99Flicker = p99Of(flicker);
  summary.ownChange = meanOf(own);
  summary.referenceChange = meanOf(reference);
  summary.switchFrames = atSwitches.size();
  summary.flickerAtSwitches = knownMean(atSwitches);
  summary.flickerElsewhere = knownMean(elsewhere);
  if (!atSwitches.empty() && summary.referenceChange > 0)
    summary.worstPopToReference = *std::max_element(atSwitches.begin(), atSwitches.end()) / summary.referenceChange;
  summary.medianMs = medianOf(ms);
  summary.p99Ms = p99Of(ms);
  summary.worstMs = *std::max_element(ms.begin(), ms.end());
  return summary;
}

std::vector<PathSummary> summarise(const PathEntry& entry) {
  std::vector<PathSummary> summaries;
  double baseline = 0;
  for (const PathRun& run : entry.runs) {
    summaries.push_back(summarise(run));
    if (run.renderer.name == kSupersampledRenderer) baseline = summaries.back().meanFlicker;
  }
  for (PathSummary& summary : summaries)
    if (baseline > 0) summary.flickerToFull4spp = summary.meanFlicker / baseline;
  return summaries;
}

}  // namespace farcell
