// What the materials that faces use make of them.
//
// OBJ files do not say which sides are seen: both are. Alpha in the image of map_Kd counts only where the material has
// an opacity (d, Tr) below 1 or an image of it (map_d), as in three.js and Blender: many images have an alpha that
// nobody looked at. What is transparent is blended: the format knows no masks.
#pragma once

#include <cstdint>
#include <filesystem>
#include <glm/vec2.hpp>
#include <span>
#include <string>
#include <unordered_map>
#include <unordered_set>
#include <vector>

#include "preprocess/mesh/texture_source.h"
#include "preprocess/read/obj/obj_materials.h"

namespace farcell {

struct ObjLook {
  uint32_t colour;          // Kd, of a face without texture coordinates
  uint32_t texturedColour;  // Kd, or white
  uint32_t texture = kNoTexture;
  uint32_t plainTexture = kNoTexture;  // of a face without texture coordinates: one without an image
  glm::vec2 scale{1}, offset{0};
};

class ObjLooks {
 public:
  ObjLooks(const ObjMaterials& materials, const std::unordered_set<std::string>& used);

  const ObjLook& find(std::string_view material) const;  // that of a material that says nothing, where it is unknown
  bool empty() const { return looks_.empty(); }
  std::span<const TextureSource> textures() const { return textures_; }
  // The images that exist.
  std::vector<std::filesystem::path> files() const;

 private:
  uint32_t textureOf(const TextureSource& wanted);

  ObjLook plain_;
  std::unordered_map<std::string, ObjLook> looks_;
  std::vector<TextureSource> textures_;
};

}  // namespace farcell
