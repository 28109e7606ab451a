#include "preprocess/read/obj/obj_materials.h"

#include <array>
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
    if (keyword == "map_Kd") {
      ObjMaterial& textured = materials_[material];
      textured.map = parseObjMap(line);
      if (textured.map) textured.mapFile = mapFile(files_.back(), *textured.map);
    }
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
  if (found == materials_.end() || (!found->second.colour && !found->second.map)) return nullptr;
  return &found->second;
}

}  // namespace farcell
