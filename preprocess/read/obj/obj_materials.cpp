#include "preprocess/read/obj/obj_materials.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <system_error>

#include "cache/base/file.h"
#include "preprocess/mesh/number_text.h"
#include "preprocess/mesh/vertices.h"
#include "preprocess/read/obj/obj_text.h"

namespace farcell {
namespace {

constexpr size_t kMaxLibraries = 256;
constexpr uint64_t kMaxLibraryBytes = uint64_t{64} << 20;

bool parseKd(std::string_view rest, uint32_t& colour) {
  std::array<double, 3> channels{};
  for (double& channel : channels)
    if (!parseNumber(takeWord(rest), channel)) return false;
  colour = packColour(channels[0], channels[1], channels[2]);
  return true;
}

// "d 0.5", "d -halo 0.5" (less where the surface is seen aslant, which is passed over)
bool parseOpacity(std::string_view rest, float& opacity) {
  std::string_view word = takeWord(rest);
  if (word == "-halo") word = takeWord(rest);
  double value = 0;
  if (!parseNumber(word, value) || !std::isfinite(value)) return false;
  opacity = static_cast<float>(std::clamp(value, 0.0, 1.0));
  return true;
}

}  // namespace

bool ObjMaterials::addLibrary(std::string_view name) {
  const std::filesystem::path path = std::filesystem::path(name).lexically_normal();
  if (!staysInside(path)) return false;
  if (libraries_.contains(path.string())) return true;
  if (libraries_.size() >= kMaxLibraries) return false;
  const Result<InputFile> file = InputFile::open(directory_ / path);
  if (!file || file->sizeBytes() > kMaxLibraryBytes) return false;
  libraries_.insert(path.string());
  files_.push_back(directory_ / path);
  ObjLines lines(*file);
  std::string material;
  for (std::string_view line; lines.next(line);) {
    const std::string_view keyword = takeWord(line);
    uint32_t colour = 0;
    if (keyword == "newmtl") material = trimmed(line);
    if (keyword == "Kd" && parseKd(line, colour)) materials_[material].colour = colour;
    float opacity = 1;
    if (keyword == "d" && parseOpacity(line, opacity)) materials_[material].opacity = opacity;
    if (keyword == "Tr" && parseOpacity(line, opacity)) materials_[material].opacity = 1 - opacity;
    if (keyword != "map_Kd" && keyword != "map_d") continue;
    ObjMaterial& textured = materials_[material];
    std::optional<ObjMap>& map = keyword == "map_Kd" ? textured.map : textured.opacityMap;
    map = parseObjMap(line);
    if (map) (keyword == "map_Kd" ? textured.mapFile : textured.opacityFile) = mapFile(files_.back(), *map);
  }
  return true;
}

void ObjMaterials::addLibraries(std::string_view names) {
  if (addLibrary(trimmed(names))) return;
  for (std::string_view word = takeWord(names); !word.empty(); word = takeWord(names)) addLibrary(word);
}

std::filesystem::path ObjMaterials::mapFile(const std::filesystem::path& library, const ObjMap& map) const {
  const std::filesystem::path beside = library.parent_path() / map.name;
  std::error_code code;
  return std::filesystem::exists(beside, code) ? beside : directory_ / map.name;
}

const ObjMaterial* ObjMaterials::find(const std::string& material) const {
  const auto found = materials_.find(material);
  if (found == materials_.end()) return nullptr;
  const ObjMaterial& known = found->second;
  return known.colour || known.map || known.opacity || known.opacityMap ? &known : nullptr;
}

}  // namespace farcell
