#include "tools/evaluate/report/fields.h"

#include <fmt/format.h>

namespace farcell {
namespace {

using Json = nlohmann::ordered_json;

const char* modeName(RenderMode mode) {
  switch (mode) {
    case RenderMode::automatic:
      return "auto";
    case RenderMode::impostors:
      return "impostors";
    case RenderMode::meshes:
      return "meshes";
    case RenderMode::triangles:
      return "triangles";
    case RenderMode::full:
      return "full";
  }
  return "";
}

const char* kindName(ImpostorKind kind) {
  switch (kind) {
    case ImpostorKind::flat:
      return "flat";
    case ImpostorKind::depthCorrected:
      return "A";
    case ImpostorKind::blended:
      return "B";
  }
  return "";
}

// RFC 4180.
std::string csvField(const std::string& text) {
  if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char c : text) quoted += c == '"' ? "\"\"" : std::string(1, c);
  return quoted + "\"";
}

// Objects become one column a member: frameMs.median.
void appendFields(const Json& json, const std::string& prefix, bool names, std::vector<std::string>& fields) {
  for (const auto& [key, value] : json.items()) {
    if (value.is_object())
      appendFields(value, prefix + key + ".", names, fields);
    else if (names)
      fields.push_back(csvField(prefix + key));
    else
      fields.push_back(value.is_null() ? "" : value.is_string() ? csvField(value.get<std::string>()) : value.dump());
  }
}

std::string settingsText(const Json& settings) {
  std::string text;
  for (const auto& [key, value] : settings.items())
    text += fmt::format("{}{}={}", text.empty() ? "" : " ", key,
                        value.is_string() ? value.get<std::string>() : value.dump());
  return text;
}

}  // namespace

Json settingsJson(const RendererPlan& plan) {
  if (plan.kind == kOctahedral) return {{"mode", kOctahedral}, {"frameEdge", plan.frameEdge}};
  const RenderSettings& settings = plan.settings;
  const bool asNeeded = settings.samplesPerPixel == kSamplesAsNeeded;
  Json json = {{"mode", modeName(settings.selection.mode)},
               {"samplesPerPixel", asNeeded ? Json("auto") : Json(settings.samplesPerPixel)}};
  if (usesTexelPixels(settings.selection.mode)) {
    json["kind"] = kindName(settings.kind);
    json["texelPixels"] = settings.selection.texelPixels;
  }
  if (usesMeshPixels(settings.selection.mode)) json["meshPixels"] = settings.selection.meshPixels;
  if (usesTriangleBudget(settings.selection.mode)) json["triangleBudget"] = settings.selection.triangleBudget;
  if (usesTimeBudget(settings.selection.mode)) json["timeBudgetMs"] = settings.selection.timeBudgetMs;
  return json;
}

Json optionalJson(const std::optional<double>& value) { return value ? Json(*value) : Json(nullptr); }

std::string csvLine(Json object, bool names) {
  if (object.contains("settings")) object["settings"] = settingsText(object["settings"]);
  std::vector<std::string> fields;
  appendFields(object, "", names, fields);
  return fmt::format("{}\n", fmt::join(fields, ","));
}

std::string printable(std::string text) {
  for (char& c : text)
    if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) c = '?';
  return text;
}

std::string optionalText(const std::optional<double>& value) { return value ? fmt::format("{:.3f}", *value) : "-"; }

}  // namespace farcell
