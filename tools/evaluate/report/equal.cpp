#include "tools/evaluate/report/equal.h"

#include <algorithm>
#include <cmath>

namespace farcell {
namespace {

// By rising time, so by falling error.
std::vector<ErrorAndTime> frontOf(std::span<const ErrorAndTime> points) {
  const std::vector<bool> on = paretoFront(points);
  std::vector<ErrorAndTime> front;
  for (size_t i = 0; i < points.size(); ++i)
    if (on[i]) front.push_back(points[i]);
  std::sort(front.begin(), front.end(), [](const ErrorAndTime& a, const ErrorAndTime& b) { return a.ms < b.ms; });
  return front;
}

// y at x on the line through (x0, y0) and (x1, y1), all as logarithms; where one is 0, a straight line.
double between(double x, double x0, double y0, double x1, double y1) {
  if (x0 == x1) return std::min(y0, y1);
  if (!(x0 > 0 && y0 > 0 && x1 > 0 && y1 > 0 && x > 0)) return y0 + (y1 - y0) * (x - x0) / (x1 - x0);
  return y0 * std::pow(y1 / y0, std::log(x / x0) / std::log(x1 / x0));
}

std::vector<ErrorAndTime> pointsOf(std::span<const Entry> entries, const std::string& stem, const std::string& kind) {
  std::vector<ErrorAndTime> points;
  for (const Entry& entry : entries)
    if (entry.stem == stem && entry.renderer.kind == kind)
      points.push_back({entry.metrics.paperError, entry.frame.medianMs});
  return points;
}

// Null: none.
const RendererPlan* subjectOf(std::span<const Entry> entries) {
  const RendererPlan* mixed = nullptr;
  for (const Entry& entry : entries) {
    if (entry.renderer.kind == "auto") return &entry.renderer;
    if (mixed == nullptr && entry.renderer.rendererClass == "mixed") mixed = &entry.renderer;
  }
  return mixed;
}

std::vector<std::string> otherKinds(std::span<const Entry> entries, const std::string& subject) {
  std::vector<std::string> kinds;
  for (const Entry& entry : entries)
    if (entry.renderer.kind != subject && std::find(kinds.begin(), kinds.end(), entry.renderer.kind) == kinds.end())
      kinds.push_back(entry.renderer.kind);
  return kinds;
}

// Of ratios above 0: their geometric mean and one end of them.
struct Ratios {
  double logs = 0, largest = 0, least = 0;
  size_t count = 0;

  void add(double ratio) {
    if (!(ratio > 0) || !std::isfinite(ratio)) return;
    largest = count == 0 ? ratio : std::max(largest, ratio);
    least = count == 0 ? ratio : std::min(least, ratio);
    logs += std::log(ratio);
    ++count;
  }
  std::optional<double> known(double value) const { return count > 0 ? std::optional(value) : std::nullopt; }
  std::optional<double> mean() const { return known(std::exp(logs / static_cast<double>(count))); }
};

EqualSummary summariseKind(const std::vector<EqualCamera>& cameras, size_t kind) {
  EqualSummary summary;
  Ratios errors, speeds;
  for (const EqualCamera& camera : cameras) {
    const EqualEntry& entry = camera.kinds[kind];
    summary.kind = entry.kind;
    ++summary.cameras;
    summary.subjectBetter += !entry.errorThere || entry.error < *entry.errorThere ? 1 : 0;
    summary.neverAsFast += entry.errorThere ? 0 : 1;
    summary.neverAsGood += entry.msThere ? 0 : 1;
    if (entry.errorThere) errors.add(entry.error / *entry.errorThere);
    if (entry.msThere) speeds.add(*entry.msThere / entry.ms);
  }
  summary.errorRatio = errors.mean();
  summary.worstErrorRatio = errors.known(errors.largest);
  summary.speed = speeds.mean();
  summary.leastSpeed = speeds.known(speeds.least);
  return summary;
}

}  // namespace

std::optional<double> errorAtTime(std::span<const ErrorAndTime> points, double ms) {
  const std::vector<ErrorAndTime> front = frontOf(points);
  if (ms < front.front().ms) return std::nullopt;
  for (size_t i = 1; i < front.size(); ++i)
    if (ms < front[i].ms) return between(ms, front[i - 1].ms, front[i - 1].error, front[i].ms, front[i].error);
  return front.back().error;
}

std::optional<double> timeAtError(std::span<const ErrorAndTime> points, double error) {
  const std::vector<ErrorAndTime> front = frontOf(points);
  if (error < front.back().error) return std::nullopt;
  if (error >= front.front().error) return front.front().ms;
  for (size_t i = 1; i < front.size(); ++i)
    if (error >= front[i].error)
      return between(error, front[i].error, front[i].ms, front[i - 1].error, front[i - 1].ms);
  return front.back().ms;
}

EqualTable equalTable(std::span<const Entry> entries) {
  EqualTable table;
  const RendererPlan* subject = subjectOf(entries);
  if (subject == nullptr) return table;
  table.subject = subject->name;
  const std::vector<std::string> kinds = otherKinds(entries, subject->kind);
  for (const Entry& own : entries) {
    if (own.renderer.name != table.subject || own.metrics.foregroundPixels == 0) continue;
    EqualCamera& camera = table.cameras.emplace_back(EqualCamera{own.camera, own.stem, {}});
    for (const std::string& kind : kinds) {
      const std::vector<ErrorAndTime> points = pointsOf(entries, own.stem, kind);
      const double ms = own.frame.medianMs, error = own.metrics.paperError;
      camera.kinds.push_back({kind, ms, error, errorAtTime(points, ms), timeAtError(points, error)});
    }
  }
  if (table.cameras.empty()) return table;
  for (size_t kind = 0; kind < kinds.size(); ++kind) table.kinds.push_back(summariseKind(table.cameras, kind));
  return table;
}

}  // namespace farcell
