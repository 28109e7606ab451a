#include "tools/evaluate/report/sun_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <glm/trigonometric.hpp>

#include "tools/evaluate/report/fields.h"
#include "tools/evaluate/report/summary.h"

namespace farcell {
namespace {

using Json = nlohmann::ordered_json;

Json sunJson(const Sun& sun) {
  return {{"azimuthDeg", glm::degrees(sun.azimuthRad)}, {"elevationDeg", glm::degrees(sun.elevationRad)}};
}

std::string csvEntry(const Sun& sun, const Entry& entry, bool names) {
  Json json = sunJson(sun);
  json.update({{"camera", entry.camera},
               {"renderer", entry.renderer.name},
               {"paperError", entry.metrics.paperError},
               {"ratioToFull1spp", optionalJson(entry.ratioToFull1spp)}});
  return csvLine(std::move(json), names);
}

// Of one renderer, by sun.
std::vector<RatioSummary> ratiosOf(const std::vector<std::vector<RendererSummary>>& suns, size_t renderer) {
  std::vector<RatioSummary> ratios;
  for (const std::vector<RendererSummary>& renderers : suns)
    if (renderers[renderer].all.ratioToFull1spp) ratios.push_back(renderers[renderer].all);
  std::sort(ratios.begin(), ratios.end(),
            [](const auto& a, const auto& b) { return *a.ratioToFull1spp < *b.ratioToFull1spp; });
  return ratios;
}

constexpr const char* kSunColumns = "{:<24} {:>6} {:>8} {:>9} {:>10} {:>13}\n";

}  // namespace

Json sunsJson(const std::vector<SunEntries>& suns) {
  Json list = Json::array();
  for (const SunEntries& under : suns) {
    Json json = sunJson(under.sun);
    json["renderers"] = Json::object();
    for (const RendererSummary& summary : summarise(under.entries))
      json["renderers"][summary.renderer] = {{"ratioToFull1spp", optionalJson(summary.all.ratioToFull1spp)},
                                             {"worstRatio", optionalJson(summary.all.worstRatio)},
                                             {"cameras", summary.all.cameras}};
    list.push_back(std::move(json));
  }
  return list;
}

std::string sunsCsv(const std::vector<SunEntries>& suns) {
  std::string text = csvEntry({}, {}, true);
  for (const SunEntries& under : suns)
    for (const Entry& entry : under.entries) text += csvEntry(under.sun, entry, false);
  return text;
}

std::string sunsText(const std::vector<SunEntries>& suns) {
  std::vector<std::vector<RendererSummary>> summaries;
  std::vector<Entry> all;
  for (const SunEntries& under : suns) {
    if (under.entries.empty()) continue;
    summaries.push_back(summarise(under.entries));
    all.insert(all.end(), under.entries.begin(), under.entries.end());
  }
  if (summaries.empty()) return "";
  std::string text = fmt::format(fmt::runtime(kSunColumns), "renderer, other suns", "suns", "ratio", "best sun",
                                 "worst sun", "worst camera");
  const std::vector<RendererSummary> means = summarise(all);
  for (size_t i = 0; i < means.size(); ++i) {
    const std::vector<RatioSummary> ratios = ratiosOf(summaries, i);
    const auto of = [&](size_t at) { return ratios.empty() ? std::nullopt : ratios[at].ratioToFull1spp; };
    text +=
        fmt::format(fmt::runtime(kSunColumns), means[i].renderer, ratios.size(),
                    optionalText(means[i].all.ratioToFull1spp), optionalText(of(0)),
                    optionalText(of(std::max<size_t>(ratios.size(), 1) - 1)), optionalText(means[i].all.worstRatio));
  }
  return text;
}

}  // namespace farcell
