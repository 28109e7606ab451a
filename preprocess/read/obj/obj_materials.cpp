#include "preprocess/read/obj/obj_materials.h"

#include <algorithm>
#include <array>

#include "cache/base/file.h"
#include "preprocess/mesh/number_text.h"
#include "preprocess/mesh/vertices.h"
#include "preprocess/read/obj/obj_text.h"

namespace farcell {
namespace {

constexpr size_t kMaxLibraries = 256;
constexpr uint64_t kMaxLibraryBytes = uint64_t{64} << 20;

bool staysInside(const std::filesystem::path& name) {
  return !name.empty() && name.is_relative() && std::find(name.begin(), name.end(), "..") == name.end();
}

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
    if (keyword == "Kd" && parseKd(line, colour)) colours_[material] = colour;
  }
  return true;
}

void ObjMaterials::addLibraries(std::string_view names) {
  if (addLibrary(trimmed(names))) return;
  for (std::string_view word = takeWord(names); !word.empty(); word = takeWord(names)) addLibrary(word);
}

const uint32_t* ObjMaterials::find(std::string_view material) const {
  const auto found = colours_.find(std::string(material));
  return found == colours_.end() ? nullptr : &found->second;
}

}  // namespace farcell
