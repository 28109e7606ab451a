#include "tools/evaluate/report/equal_report.h"

#include <fmt/format.h>

#include <algorithm>

#include "tools/evaluate/report/fields.h"

namespace farcell {
namespace {

using Json = nlohmann::ordered_json;

Json summaryJson(const EqualSummary& summary) {
  return {{"kind", summary.kind},
          {"cameras", summary.cameras},
          {"subjectBetter", summary.subjectBetter},
          {"neverAsFast", summary.neverAsFast},
          {"neverAsGood", summary.neverAsGood},
          {"errorRatio", optionalJson(summary.errorRatio)},
          {"worstErrorRatio", optionalJson(summary.worstErrorRatio)},
          {"speed", optionalJson(summary.speed)},
          {"leastSpeed", optionalJson(summary.leastSpeed)}};
}

Json entryJson(const EqualEntry& entry) {
  return {{"kind", entry.kind},
          {"ms", entry.ms},
          {"error", entry.error},
          {"errorThere", optionalJson(entry.errorThere)},
          {"msThere", optionalJson(entry.msThere)}};
}

std::string csvEntry(const std::string& camera, const EqualEntry& entry, bool names) {
  Json json = {{"camera", camera}};
  json.update(entryJson(entry));
  return csvLine(std::move(json), names);
}

constexpr const char* kColumns = "{:<{}} {:>14} {:>8} {:>8} {:>13} {:>8} {:>8}\n";

}  // namespace

Json equalJson(const EqualTable& table) {
  Json json = {{"subject", table.subject}, {"kinds", Json::array()}, {"cameras", Json::array()}};
  for (const EqualSummary& summary : table.kinds) json["kinds"].push_back(summaryJson(summary));
  for (const EqualCamera& camera : table.cameras) {
    Json kinds = Json::array();
    for (const EqualEntry& entry : camera.kinds) kinds.push_back(entryJson(entry));
    json["cameras"].push_back({{"camera", camera.camera}, {"stem", camera.stem}, {"kinds", std::move(kinds)}});
  }
  return json;
}

std::string equalCsv(const EqualTable& table) {
  std::string text = csvEntry("", {}, true);
  for (const EqualCamera& camera : table.cameras)
    for (const EqualEntry& entry : camera.kinds) text += csvEntry(camera.camera, entry, false);
  return text;
}

std::string equalText(const EqualTable& table) {
  if (table.kinds.empty()) return "";
  size_t width = 24;
  for (const EqualSummary& summary : table.kinds) width = std::max(width, summary.kind.size());
  std::string text = fmt::format(fmt::runtime(kColumns), fmt::format("{} against", table.subject), width,
                                 "less error (n)", "ratio", "worst", "never as good", "faster", "least");
  for (const EqualSummary& s : table.kinds)
    text += fmt::format(fmt::runtime(kColumns), s.kind, width, fmt::format("{} ({})", s.subjectBetter, s.cameras),
                        optionalText(s.errorRatio), optionalText(s.worstErrorRatio), s.neverAsGood,
                        optionalText(s.speed), optionalText(s.leastSpeed));
  return text;
}

}  // namespace farcell
