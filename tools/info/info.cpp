#include "tools/info/info.h"

#include <algorithm>
#include <array>
#include <glm/common.hpp>
#include <glm/trigonometric.hpp>
#include <limits>

#include "cache/base/interrupt.h"
#include "tools/report/build_report_json.h"

namespace farcell {
namespace {

using Json = nlohmann::ordered_json;

Json pointJson(glm::dvec3 p) { return Json::array({p.x, p.y, p.z}); }

Json boundsJson(glm::dvec3 min, glm::dvec3 max) { return {{"min", pointJson(min)}, {"max", pointJson(max)}}; }

std::string upName(UpAxis up) { return std::string(1, "xyz"[static_cast<uint32_t>(up)]); }

Json modelJson(const Directory& directory) {
  const Model& model = directory.model;
  const Grid& grid = model.grid;
  Json json;
  json["source"] = directory.sourceName;
  json["sourceHash"] = fmt::format("{:016x}", directory.sourceHash);
  json["grid"] = {{"origin", pointJson(grid.origin)}, {"side", grid.side}, {"bits", grid.bits}};
  json["bounds"] = model.bounds.empty()
                       ? Json()
                       : boundsJson(grid.worldFromGrid(model.bounds.min), grid.worldFromGrid(model.bounds.max));
  json["up"] = upName(model.settings.up);
  json["metresPerUnit"] = model.settings.metresPerUnit;
  json["hasColours"] = model.hasColours;
  json["hasNormals"] = model.hasNormals;
  return json;
}

Json settingsJson(const BuildSettings& settings) {
  return {{"views", settings.form.views},
          {"imageSize", settings.form.imageSize},
          {"forms", formsName(settings.forms)},
          {"samples", settings.samples},
          {"leafTriangles", settings.leafTriangles},
          {"maxLevel", settings.maxLevel},
          {"fixedLevel", settings.fixedLevel},
          {"lighting", settings.lighting == Lighting::relightable ? "relightable" : "baked"},
          {"sun", {glm::degrees(settings.sun.azimuthRad), glm::degrees(settings.sun.elevationRad)}},
          {"measure", settings.measure == Measure::off   ? "off"
                      : settings.measure == Measure::all ? "all"
                                                         : "sample"},
          {"viewError", settings.viewError},
          {"simplifier", settings.simplifier == Simplifier::openmesh ? "openmesh" : "collapse"},
          {"packBudgetBytes", settings.packBudgetBytes},
          {"budgetRule", settings.budgetRule == BudgetRule::triangles ? "triangles" : "worth"},
          {"visitableHash", fmt::format("{:016x}", settings.visitableHash)}};
}

// One entry a level: its leaves, its inner cells, the triangles of its leaves, those of its inner cells' meshes and the
// largest geometric error of these.
Json levelsJson(const Directory& directory) {
  struct Level {
    uint64_t leaf = 0;
    uint64_t inner = 0;
    uint64_t triangles = 0;
    uint64_t meshTriangles = 0;
    double geometricError = 0;
  };
  std::vector<Level> levels;
  for (const CellRecord& cell : directory.cells) {
    levels.resize(std::max<size_t>(levels.size(), cell.key.level + 1));
    Level& level = levels[cell.key.level];
    const bool leaf = cell.childCount == 0;
    (leaf ? level.leaf : level.inner) += 1;
    (leaf ? level.triangles : level.meshTriangles) += cell.meshTriangles;
    level.geometricError = std::max(level.geometricError, cell.geometricError);
  }
  Json json = Json::array();
  for (size_t i = 0; i < levels.size(); ++i)
    json.push_back({{"level", i},
                    {"leaf", levels[i].leaf},
                    {"inner", levels[i].inner},
                    {"triangles", levels[i].triangles},
                    {"meshTriangles", levels[i].meshTriangles},
                    {"geometricErrorMetres", levels[i].geometricError * directory.model.settings.metresPerUnit}});
  return json;
}

// Of each way to draw cells: how many have an error, and its median, at each size of a texel on screen.
Json errorsJson(const Directory& directory) {
  constexpr std::array<const char*, kErrorWays> kNames = {"mesh", "depthCorrected", "blended"};
  Json json = Json::object();
  for (size_t way = 0; way < kErrorWays; ++way) {
    Json medians = Json::array();
    std::vector<uint8_t> codes;
    for (size_t scale = 0; scale < kErrorScales; ++scale) {
      codes.clear();
      for (const CellRecord& cell : directory.cells)
        if (cell.errors.knows(static_cast<ErrorWay>(way))) codes.push_back(cell.errors.codes[way][scale]);
      if (codes.empty()) break;
      const auto middle = codes.begin() + static_cast<ptrdiff_t>(codes.size() / 2);
      std::nth_element(codes.begin(), middle, codes.end());
      medians.push_back(errorFromCode(*middle));
    }
    if (!codes.empty()) json[kNames[way]] = {{"cells", codes.size()}, {"median", medians}};
  }
  json["texelPixels"] = kErrorTexelPixels;
  return json;
}

// Control characters of names from outside must not reach a terminal.
std::string printable(std::string text) {
  for (char& c : text)
    if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) c = '?';
  return text;
}

std::string valueText(const Json& value) {
  if (value.is_string()) return printable(value.get<std::string>());
  return value.dump(-1, ' ', false, Json::error_handler_t::replace);
}

void appendText(std::string& text, const std::string& key, const Json& value, size_t depth) {
  const std::string indent(2 * depth, ' ');
  const bool flat = std::none_of(value.begin(), value.end(), [](const Json& v) { return v.is_structured(); });
  if (value.is_object() && !value.empty()) {
    text += fmt::format("{}{}\n", indent, printable(key));
    for (const auto& [name, member] : value.items()) appendText(text, name, member, depth + 1);
  } else if (value.is_array() && !flat) {
    text += fmt::format("{}{}\n", indent, printable(key));
    for (const Json& element : value) text += fmt::format("{}  {}\n", indent, valueText(element));
  } else {
    text +=
        fmt::format("{}{:<{}} {}\n", indent, printable(key), 24 - std::min<size_t>(2 * depth, 20), valueText(value));
  }
}

}  // namespace

Json packInfoJson(const PackFile& pack) {
  const Directory& directory = pack.directory();
  const auto pagesOf = [&](PageKind kind) {
    return std::count_if(directory.pages.begin(), directory.pages.end(),
                         [&](const PageRecord& page) { return page.kind == kind; });
  };
  Json json = buildReportJson(directory, pack.sizeBytes(), nullptr, nullptr);
  json["format"] = {{"version", kPackVersion}};
  json["model"] = modelJson(directory);
  json["settings"] = settingsJson(directory.model.settings);
  json["levels"] = levelsJson(directory);
  json["errors"] = errorsJson(directory);
  json["pages"] = {{"geometry", pagesOf(PageKind::geometry)},
                   {"views", pagesOf(PageKind::views)},
                   {"textures", pagesOf(PageKind::texture)}};
  return json;
}

Result<Json> meshInfoJson(MeshReader& mesh) {
  glm::dvec3 min(std::numeric_limits<double>::infinity());
  glm::dvec3 max(-std::numeric_limits<double>::infinity());
  FARCELL_ASSIGN(const MeshCounts counts, mesh.forEachTriangle([&](std::span<const InputTriangle> batch) -> Result<> {
    for (const InputTriangle& triangle : batch)
      for (const glm::dvec3& position : triangle.positions) {
        min = glm::min(min, position);
        max = glm::max(max, position);
      }
    return checkInterrupt();
  }));
  Json skipped = Json::object();
  for (const auto& [reason, count] : counts.skipped) skipped[reason] = count;
  const MeshInfo& info = mesh.info();
  Json json;
  json["format"] = info.format;
  json["files"] = mesh.files().size();
  json["input"] = {{"triangles", counts.accepted}, {"vertices", info.vertices}, {"skipped", skipped}};
  json["declaredTriangles"] = info.declaredTriangles;
  json["bounds"] = counts.accepted == 0 ? Json() : boundsJson(min, max);
  json["up"] = upName(info.up);
  json["metresPerUnit"] = info.metresPerUnit;
  json["hasColours"] = info.hasColours;
  json["hasNormals"] = info.hasNormals;
  json["textures"] = mesh.textures().size();
  return json;
}

std::string infoText(const Json& info) {
  std::string text;
  for (const auto& [key, value] : info.items()) appendText(text, key, value, 0);
  return text;
}

}  // namespace farcell
