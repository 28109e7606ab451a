#include "tools/evaluate/report/summary.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <map>

#include "tools/evaluate/report/pareto.h"

namespace farcell {
namespace {

RatioSummary summariseRatios(std::span<const Entry> entries, const std::function<bool(const Entry&)>& chosen) {
  RatioSummary summary;
  double logs = 0, worst = 0;
  for (const Entry& entry : entries) {
    if (!entry.ratioToFull1spp || !chosen(entry)) continue;
    ++summary.cameras;
    logs += std::log(*entry.ratioToFull1spp);  // of 0: minus infinity, and the mean becomes 0, as it should
    worst = std::max(worst, *entry.ratioToFull1spp);
  }
  if (summary.cameras == 0) return summary;
  summary.ratioToFull1spp = std::exp(logs / static_cast<double>(summary.cameras));
  summary.worstRatio = worst;
  return summary;
}

RendererSummary summariseRenderer(std::span<const Entry> entries, const RendererPlan& renderer) {
  const auto own = [&](const Entry& entry) { return entry.renderer.name == renderer.name; };
  const auto impostors = [&](const Entry& entry) { return entry.metrics.impostorShare >= kMostlyImpostors; };
  RendererSummary summary{renderer.name, renderer.rendererClass, {}, {}, {}, 0, 0, 0, 0, false};
  summary.all = summariseRatios(entries, own);
  summary.mostlyImpostors = summariseRatios(entries, [&](const Entry& e) { return own(e) && impostors(e); });
  summary.elsewhere = summariseRatios(entries, [&](const Entry& e) { return own(e) && !impostors(e); });
  std::vector<double> frames, triangles;
  for (const Entry& entry : entries) {
    if (!own(entry)) continue;
    frames.push_back(entry.frame.medianMs);
    triangles.push_back(static_cast<double>(entry.triangles));
    summary.worstHoleRate = std::max(summary.worstHoleRate, entry.metrics.holeRate);
    summary.meanFlip += entry.metrics.flip;
  }
  summary.medianFrameMs = medianOf(frames);
  summary.medianTriangles = medianOf(triangles);
  summary.meanFlip /= static_cast<double>(frames.size());
  return summary;
}

void markFront(std::vector<RendererSummary>& summaries) {
  std::vector<ErrorAndTime> points;
  for (const RendererSummary& summary : summaries)
    points.push_back(
        {summary.all.ratioToFull1spp.value_or(std::numeric_limits<double>::infinity()), summary.medianFrameMs});
  const std::vector<bool> front = paretoFront(points);
  for (size_t i = 0; i < summaries.size(); ++i)
    summaries[i].onParetoFront = front[i] && summaries[i].all.ratioToFull1spp.has_value();
}

}  // namespace

void setRatios(std::vector<Entry>& entries) {
  std::map<std::string, double> baselines;
  for (const Entry& entry : entries)
    if (entry.renderer.name == kBaselineRenderer) baselines[entry.camera] = entry.metrics.paperError;
  for (Entry& entry : entries) {
    const auto baseline = baselines.find(entry.camera);
    if (baseline == baselines.end() || baseline->second <= 0) continue;
    entry.ratioToFull1spp = entry.metrics.paperError / baseline->second;
  }
}

std::vector<RendererSummary> summarise(std::span<const Entry> entries) {
  std::vector<RendererSummary> summaries;
  for (const Entry& entry : entries) {
    const bool known = std::any_of(summaries.begin(), summaries.end(), [&](const RendererSummary& summary) {
      return summary.renderer == entry.renderer.name;
    });
    if (!known) summaries.push_back(summariseRenderer(entries, entry.renderer));
  }
  markFront(summaries);
  return summaries;
}

}  // namespace farcell
