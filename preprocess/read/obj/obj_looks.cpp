#include "preprocess/read/obj/obj_looks.h"

#include <algorithm>
#include <set>
#include <system_error>

#include "preprocess/mesh/vertices.h"

namespace farcell {
namespace {
constexpr uint32_t kWhite = 0xffffff;
}

ObjLooks::ObjLooks(const ObjMaterials& materials, const std::unordered_set<std::string>& used)
    : plain_{defaultColour(), kWhite} {
  for (const std::string& name : std::set<std::string>(used.begin(), used.end())) {  // in an order of its own
    const ObjMaterial* material = materials.find(name);
    if (material == nullptr) continue;
    ObjLook look{material->colour.value_or(defaultColour()), material->colour.value_or(kWhite)};
    if (material->map) {
      look.texture = textureOf(*material);
      look.scale = material->map->scale;
      look.offset = material->map->offset;
    }
    looks_.emplace(name, look);
  }
}

const ObjLook& ObjLooks::find(std::string_view material) const {
  const auto found = looks_.find(std::string(material));
  return found == looks_.end() ? plain_ : found->second;
}

std::vector<std::filesystem::path> ObjLooks::files() const {
  std::vector<std::filesystem::path> files;
  for (const TextureSource& texture : textures_) {
    std::error_code code;
    if (!std::filesystem::is_regular_file(texture.file, code)) continue;
    if (std::find(files.begin(), files.end(), texture.file) == files.end()) files.push_back(texture.file);
  }
  return files;
}

// Materials share an image that they wrap alike.
uint32_t ObjLooks::textureOf(const ObjMaterial& material) {
  const TextureWrap wrap = material.map->clamped ? TextureWrap::clamp : TextureWrap::repeat;
  size_t i = 0;
  while (i < textures_.size() && (textures_[i].file != material.mapFile || textures_[i].wrapU != wrap)) ++i;
  if (i == textures_.size()) {
    textures_.emplace_back().file = material.mapFile;
    textures_[i].wrapU = textures_[i].wrapV = wrap;
  }
  return static_cast<uint32_t>(i);
}

}  // namespace farcell
