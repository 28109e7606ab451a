#include "preprocess/read/obj/obj_looks.h"

#include <algorithm>
#include <set>
#include <system_error>

#include "preprocess/mesh/vertices.h"

namespace farcell {
namespace {
constexpr uint32_t kWhite = 0xffffff;

bool isFile(const std::filesystem::path& path) {
  std::error_code code;
  return std::filesystem::is_regular_file(path, code);
}

// An image that both maps name has what both want: its colours and its alpha.
TextureSource sourceOf(const ObjMaterial& material) {
  TextureSource source;
  const bool hasOpacityMap = material.opacityMap && isFile(material.opacityFile);
  source.surface.hasImage = material.map || hasOpacityMap;
  source.opacity = material.opacity.value_or(1.0f);
  if (hasOpacityMap || source.opacity < 1) source.surface.alpha = AlphaMode::blend;
  if (material.map) source.file = material.mapFile;
  if (hasOpacityMap && material.opacityFile != source.file) source.opacityFile = material.opacityFile;
  const bool clamped = (material.map ? material.map : material.opacityMap).value_or(ObjMap{}).clamped;
  source.wrapU = source.wrapV = clamped ? TextureWrap::clamp : TextureWrap::repeat;
  return source;
}

TextureSource withoutImages(const TextureSource& source) {
  TextureSource plain;
  plain.surface = source.surface;
  plain.surface.hasImage = false;
  plain.opacity = source.opacity;
  return plain;
}

bool areAlike(const TextureSource& a, const TextureSource& b) {
  return a.file == b.file && a.opacityFile == b.opacityFile && a.wrapU == b.wrapU && a.surface == b.surface &&
         a.opacity == b.opacity;
}
}  // namespace

ObjLooks::ObjLooks(const ObjMaterials& materials, const std::unordered_set<std::string>& used)
    : plain_{defaultColour(), kWhite} {
  for (const std::string& name : std::set<std::string>(used.begin(), used.end())) {  // in an order of its own
    const ObjMaterial* material = materials.find(name);
    if (material == nullptr) continue;
    ObjLook look{material->colour.value_or(defaultColour()), material->colour.value_or(kWhite)};
    const TextureSource source = sourceOf(*material);
    if (!source.surface.whole()) look.plainTexture = textureOf(withoutImages(source));
    look.texture = source.surface.hasImage ? textureOf(source) : look.plainTexture;
    if (const auto& map = material->map ? material->map : material->opacityMap) {
      look.scale = map->scale;
      look.offset = map->offset;
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
  for (const TextureSource& texture : textures_)
    for (const std::filesystem::path& file : {texture.file, texture.opacityFile})
      if (isFile(file) && std::find(files.begin(), files.end(), file) == files.end()) files.push_back(file);
  return files;
}

// Materials share what they use alike.
uint32_t ObjLooks::textureOf(const TextureSource& wanted) {
  const auto found = std::find_if(textures_.begin(), textures_.end(),
                                  [&](const TextureSource& known) { return areAlike(known, wanted); });
  const auto index = static_cast<uint32_t>(found - textures_.begin());
  if (found == textures_.end()) textures_.push_back(wanted);
  return index;
}

}  // namespace farcell
