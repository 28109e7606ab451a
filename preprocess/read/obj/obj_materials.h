// Diffuse colours (Kd) of the materials that an OBJ file names.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <unordered_map>
#include <unordered_set>
#include <vector>

namespace farcell {

class ObjMaterials {
 public:
  // directory: that of the OBJ file.
  explicit ObjMaterials(std::filesystem::path directory) : directory_(std::move(directory)) {}

  // The rest of an mtllib statement: one name with blanks in it, or several. A library that is missing, broken or
  // outside the directory brings no materials and is no error: shapes do not depend on it.
  void addLibraries(std::string_view names);
  // Null when the material is unknown or has no Kd.
  const uint32_t* find(std::string_view material) const;
  // The libraries that were read, in the order of the OBJ file.
  const std::vector<std::filesystem::path>& files() const { return files_; }

 private:
  bool addLibrary(std::string_view name);

  std::filesystem::path directory_;
  std::unordered_map<std::string, uint32_t> colours_;
  std::unordered_set<std::string> libraries_;  // names read already
  std::vector<std::filesystem::path> files_;
};

}  // namespace farcell
