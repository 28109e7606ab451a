// The textures of a mesh in memory, looked at point by point: the truth averages samples, not the texture.
#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec4.hpp>
#include <span>
#include <utility>
#include <vector>

#include "preprocess/texture/image_rows.h"

namespace farcell {

class WholeTextures {
 public:
  WholeTextures() = default;
  // An image that cannot be read is white: its triangles keep the colours they have without it, as in a build. Ends
  // with `cancelled` on Ctrl-C.
  static Result<WholeTextures> read(std::span<const TextureSource> sources);

  // Adds an image that is held beyond its edges.
  void add(TextureImage image, AlphaMode alpha) {
    textures_.push_back({std::move(image), TextureWrap::clamp, TextureWrap::clamp, {.alpha = alpha}});
  }

  bool empty() const { return textures_.empty(); }
  // Between the four nearest pixels: R, G, B of what is surface, and how much of what is seen there it makes: for a
  // mask 0 or 1. All in [0, 1]. Any thread.
  glm::vec4 colourAt(uint32_t texture, glm::vec2 at) const;
  // Opaque when the image could not be read.
  const SurfaceKind& surface(uint32_t texture) const { return textures_[texture].surface; }

 private:
  struct Texture {
    TextureImage image;  // empty: white
    TextureWrap wrapU, wrapV;
    SurfaceKind surface;
  };
  std::vector<Texture> textures_;
};

}  // namespace farcell
