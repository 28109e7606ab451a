// Diffuse colours (Kd), opacities (d, Tr) and the textures of both (map_Kd, map_d) of the materials that an OBJ file
// names.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>
#include <unordered_set>
#include <vector>

#include "preprocess/read/obj/obj_map.h"

namespace farcell {

struct ObjMaterial {
  std::optional<uint32_t> colour;  // 0x00BBGGRR
  std::optional<ObjMap> map;
  std::filesystem::path mapFile;  // beside the library that names it, or else beside the OBJ file; with a map
  std::optional<float> opacity;   // in [0, 1]
  std::optional<ObjMap> opacityMap;
  std::filesystem::path opacityFile;  // likewise
};

class ObjMaterials {
 public:
  // directory: that of the OBJ file.
  explicit ObjMaterials(std::filesystem::path directory) : directory_(std::move(directory)) {}

  // The rest of an mtllib statement: one name with blanks in it, or several. A library that is missing, broken or
  // outside the directory brings no materials and is no error: shapes do not depend on it.
  void addLibraries(std::string_view names);
  // The libraries that were read, in the order of the OBJ file.
  const std::vector<std::filesystem::path>& files() const { return files_; }
  // Null when the material is unknown or says nothing of the above.
  const ObjMaterial* find(const std::string& material) const;

 private:
  bool addLibrary(std::string_view name);
  std::filesystem::path mapFile(const std::filesystem::path& library, const ObjMap& map) const;

  std::filesystem::path directory_;
  std::unordered_map<std::string, ObjMaterial> materials_;
  std::unordered_set<std::string> libraries_;  // names read already
  std::vector<std::filesystem::path> files_;
};

}  // namespace farcell
