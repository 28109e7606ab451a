#include "tools/report/build_report_json.h"

#include <algorithm>
#include <map>
#include <string>

namespace farcell {
namespace {

using Json = nlohmann::ordered_json;

// An object even when empty.
Json countsJson(const std::map<std::string, uint64_t>& counts) {
  Json json = Json::object();
  for (const auto& [reason, count] : counts) json[reason] = count;
  return json;
}

Json secondsJson(const BuildTimes* times) {
  const auto value = [times](double BuildTimes::*stage) { return times == nullptr ? Json() : Json(times->*stage); };
  Json json;
  json["read"] = value(&BuildTimes::read);
  json["partition"] = value(&BuildTimes::partition);
  json["lod"] = value(&BuildTimes::lod);
  json["bake"] = value(&BuildTimes::bake);
  json["encode"] = value(&BuildTimes::encode);
  json["total"] = value(&BuildTimes::total);
  return json;
}

}  // namespace

Json buildReportJson(const Directory& directory, uint64_t packBytes, const BuildTimes* timesOrNull,
                     const uint64_t* peakRssOrNull) {
  const BuildReport& report = directory.report;
  const auto leaves = std::count_if(directory.cells.begin(), directory.cells.end(),
                                    [](const CellRecord& cell) { return cell.childCount == 0; });
  Json json;
  json["input"] = {{"triangles", report.inputTriangles},
                   {"vertices", report.inputVertices},
                   {"skipped", countsJson(report.skipped)}};
  json["cells"] = {{"leaf", leaves}, {"inner", static_cast<int64_t>(directory.cells.size()) - leaves}};
  json["views"] = {
      {"baked", report.viewsBaked}, {"kept", report.viewsKept}, {"leftOut", countsJson(report.viewsLeftOut)}};
  json["bytes"] = {{"pack", packBytes},
                   {"impostors", report.impostorBytes},
                   {"impostorsRaw", report.impostorRawBytes},
                   {"geometry", report.geometryBytes},
                   {"textures", report.textureBytes}};
  json["seconds"] = secondsJson(timesOrNull);
  json["peakRssBytes"] = peakRssOrNull == nullptr ? Json() : Json(*peakRssOrNull);
  return json;
}

std::string jsonText(const Json& json) { return json.dump(2, ' ', false, Json::error_handler_t::replace); }

}  // namespace farcell
