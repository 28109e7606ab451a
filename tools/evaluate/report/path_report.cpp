#include "tools/evaluate/report/path_report.h"

#include <fmt/format.h>

#include <algorithm>

#include "tools/evaluate/report/fields.h"

namespace farcell {
namespace {

using Json = nlohmann::ordered_json;

Json frameJson(const PathFrame& frame) {
  return {{"paperError", frame.paperError},
          {"flicker", frame.change.flicker},
          {"ownChange", frame.change.own},
          {"referenceChange", frame.change.reference},
          {"viewSwitches", frame.viewSwitches},
          {"levelSwitches", frame.levelSwitches},
          {"ms", frame.wallMs},
          {"cpuMs", frame.cpuMs},
          {"bytesRead", frame.bytesRead},
          {"triangles", frame.triangles},
          {"impostors", frame.impostors}};
}

// By column: one array a figure.
Json framesJson(const std::vector<PathFrame>& frames) {
  Json columns = Json::object();
  const Json none = frameJson({});
  for (const auto& [key, value] : none.items()) columns[key] = Json::array();
  for (const PathFrame& frame : frames) {
    const Json figures = frameJson(frame);
    for (const auto& [key, value] : figures.items()) columns[key].push_back(value);
  }
  return columns;
}

Json summaryJson(const PathSummary& summary) {
  return {{"frames", summary.frames},
          {"meanError", summary.meanError},
          {"meanFlicker", summary.meanFlicker},
          {"flickerToFull4spp", optionalJson(summary.flickerToFull4spp)},
          {"p99Flicker", summary.p99Flicker},
          {"worstFlicker", summary.worstFlicker},
          {"worstFrame", summary.worstFrame},
          {"ownChange", summary.ownChange},
          {"referenceChange", summary.referenceChange},
          {"switchFrames", summary.switchFrames},
          {"viewSwitches", summary.viewSwitches},
          {"levelSwitches", summary.levelSwitches},
          {"flickerAtSwitches", optionalJson(summary.flickerAtSwitches)},
          {"flickerElsewhere", optionalJson(summary.flickerElsewhere)},
          {"worstPopToReference", summary.worstPopToReference},
          {"medianMs", summary.medianMs},
          {"p99Ms", summary.p99Ms},
          {"worstMs", summary.worstMs}};
}

Json pathJson(const PathEntry& path) {
  const std::vector<PathSummary> summaries = summarise(path);
  Json json = {{"name", path.name},
               {"stem", path.stem},
               {"frames", path.runs.empty() ? 0 : path.runs.front().frames.size()},
               {"renderers", Json::array()}};
  for (size_t i = 0; i < path.runs.size(); ++i) {
    const PathRun& run = path.runs[i];
    json["renderers"].push_back({{"renderer", run.renderer.name},
                                 {"class", run.renderer.rendererClass},
                                 {"kind", run.renderer.kind},
                                 {"settings", settingsJson(run.renderer)},
                                 {"summary", summaryJson(summaries[i])},
                                 {"frames", framesJson(run.frames)}});
  }
  return json;
}

std::string csvFrame(const std::string& path, size_t number, const PathRun& run, const PathFrame& frame, bool names) {
  Json json = {{"path", path}, {"frame", number}, {"renderer", run.renderer.name}};
  json.update(frameJson(frame));
  return csvLine(std::move(json), names);
}

constexpr const char* kColumns = "{:<20} {:<{}} {:>8} {:>8} {:>8} {:>8} {:>8} {:>6} {:>8} {:>8} {:>8} {:>9} {:>9}\n";

std::string tableLine(const PathEntry& path, const PathRun& run, const PathSummary& summary, size_t width) {
  const auto figure = [](double value) { return fmt::format("{:.3f}", value); };
  return fmt::format(fmt::runtime(kColumns), printable(path.name), run.renderer.name, width, figure(summary.meanError),
                     figure(summary.meanFlicker), optionalText(summary.flickerToFull4spp), figure(summary.p99Flicker),
                     figure(summary.worstFlicker), summary.worstFrame, summary.switchFrames,
                     optionalText(summary.flickerAtSwitches), optionalText(summary.flickerElsewhere),
                     figure(summary.referenceChange), fmt::format("{:.2f}", summary.medianMs));
}

}  // namespace

Json pathsJson(std::span<const PathEntry> paths) {
  Json json = Json::array();
  for (const PathEntry& path : paths) json.push_back(pathJson(path));
  return json;
}

std::string pathsCsv(std::span<const PathEntry> paths) {
  std::string text = csvFrame("", 0, {}, {}, true);
  for (const PathEntry& path : paths)
    for (const PathRun& run : path.runs)
      for (size_t i = 0; i < run.frames.size(); ++i) text += csvFrame(path.name, i, run, run.frames[i], false);
  return text;
}

std::string pathsTable(std::span<const PathEntry> paths) {
  size_t width = 10;
  for (const PathEntry& path : paths)
    for (const PathRun& run : path.runs) width = std::max(width, run.renderer.name.size());
  std::string text = fmt::format(fmt::runtime(kColumns), "path", "renderer", width, "error", "flicker", "to 4spp",
                                 "p99", "worst", "at", "switches", "there", "else", "reference", "frame ms");
  for (const PathEntry& path : paths) {
    const std::vector<PathSummary> summaries = summarise(path);
    for (size_t i = 0; i < path.runs.size(); ++i) text += tableLine(path, path.runs[i], summaries[i], width);
  }
  return text;
}

}  // namespace farcell
