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
  RendererSummary summary;
  summary.renderer = renderer.name;
  summary.rendererClass = renderer.rendererClass;
  summary.kind = renderer.kind;
  summary.all = summariseRatios(entries, own);
  summary.mostlyImpostors = summariseRatios(entries, [&](const Entry& e) { return own(e) && impostors(e); });
  summary.elsewhere = summariseRatios(entries, [&](const Entry& e) { return own(e) && !impostors(e); });
  std::vector<double> frames, triangles, bytes;
  for (const Entry& entry : entries) {
    if (!own(entry)) continue;
    frames.push_back(entry.frame.medianMs);
    triangles.push_back(static_cast<double>(entry.triangles));
    bytes.push_back(static_cast<double>(entry.bytesRead));
    summary.worstHoleRate = std::max(summary.worstHoleRate, entry.metrics.holeRate);
    summary.meanFlip += entry.metrics.flip;
  }
  summary.medianFrameMs = medianOf(frames);
  summary.medianTriangles = medianOf(triangles);
  summary.medianBytesRead = medianOf(bytes);
  summary.meanFlip /= static_cast<double>(frames.size());
  return summary;
}

// Marks those of `members` that lie on their front of ratio and cost.
void markFront(std::vector<RendererSummary>& summaries, const std::vector<size_t>& members,
               double RendererSummary::*cost, bool RendererSummary::*mark) {
  std::vector<ErrorAndTime> points;
  for (const size_t i : members)
    points.push_back(
        {summaries[i].all.ratioToFull1spp.value_or(std::numeric_limits<double>::infinity()), summaries[i].*cost});
  const std::vector<bool> front = paretoFront(points);
  for (size_t k = 0; k < members.size(); ++k) {
    RendererSummary& summary = summaries[members[k]];
    summary.*mark = front[k] && summary.all.ratioToFull1spp.has_value();
  }
}

void markFronts(std::vector<RendererSummary>& summaries) {
  std::map<std::string, std::vector<size_t>> kinds;
  std::vector<size_t> all;
  for (size_t i = 0; i < summaries.size(); ++i) {
    kinds[summaries[i].kind].push_back(i);
    all.push_back(i);
  }
  using Summary = RendererSummary;
  markFront(summaries, all, &Summary::medianFrameMs, &Summary::onParetoFront);
  markFront(summaries, all, &Summary::medianBytesRead, &Summary::onBytesFront);
  for (const auto& [kind, members] : kinds) {
    markFront(summaries, members, &Summary::medianFrameMs, &Summary::onKindFront);
    markFront(summaries, members, &Summary::medianBytesRead, &Summary::onKindBytesFront);
  }
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
  markFronts(summaries);
  return summaries;
}

}  // namespace farcell
