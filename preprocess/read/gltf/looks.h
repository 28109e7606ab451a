// What materials say of a surface: its colour, where it is none, and from which sides it is seen.
#pragma once

#include <array>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <vector>

#include "preprocess/mesh/texture_source.h"
#include "preprocess/read/gltf/buffers.h"

namespace tinygltf {
class Model;
}

namespace farcell {

// Of the coordinates in the file (v down) in the order of KHR_texture_transform: scale, rotation, offset.
struct TextureTransform {
  glm::dvec2 scale{1};
  double cosine = 1;
  double sine = 0;
  glm::dvec2 offset{0};

  glm::dvec2 apply(glm::dvec2 uv) const;
  bool operator==(const TextureTransform&) const = default;
};

struct GltfLook {
  glm::dvec3 factor{1};  // of the base colour, linear light
  uint32_t texture = kNoTexture;
  bool hasImage = false;            // the texture: corners need coordinates on it
  uint32_t textureCoordinates = 0;  // the set: TEXCOORD_n
  TextureTransform transform;
};

// An entry of "images".
struct GltfImage {
  std::string uri;               // or
  std::optional<uint64_t> view;  // one of the two
};
// From the checked JSON (gltf_shape.h).
std::vector<GltfImage> imagesOf(const nlohmann::json& root);

// Linear light in [0, 1] as a display value in [0, 1] (IEC 61966-2-1, sRGB); others are clamped, NaN gives 0.
double displayFromLinear(double linear);
uint32_t displayColour(glm::dvec3 linear);  // 0x00BBGGRR

// Materials as they are asked for, and the textures that these name.
class GltfLooks {
 public:
  // All must outlive the looks.
  GltfLooks(const tinygltf::Model& model, std::vector<GltfImage> images, GltfBuffers& buffers)
      : model_(model), images_(std::move(images)), buffers_(buffers) {}

  // material -1: none. White, and seen from both sides: a mesh that names no material says nothing about sides.
  Result<GltfLook> look(const GltfPlace& user, int material);
  // The texture of corners without coordinates on the material's image: none, or one without an image.
  Result<uint32_t> plainTexture(size_t material);
  // Named by the looks given so far.
  std::vector<TextureSource> takeTextures() { return std::move(textures_); }

 private:
  struct Known {
    std::optional<uint64_t> image;
    std::array<TextureWrap, 2> wrap{};
    SurfaceKind surface;
    float opacity = 1;
    bool operator==(const Known&) const = default;
  };
  Result<uint32_t> texture(size_t material);
  Result<uint32_t> entry(const Known& wanted);
  Result<Known> withoutImage(size_t material) const;
  Result<std::array<TextureWrap, 2>> wrapsOf(const GltfPlace& place, int sampler) const;
  Result<TextureSource> source(const Known& wanted);

  const tinygltf::Model& model_;
  std::vector<GltfImage> images_;
  GltfBuffers& buffers_;
  std::vector<TextureSource> textures_;
  std::vector<Known> known_;  // of textures_, one for one
};

}  // namespace farcell
