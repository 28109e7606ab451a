// The mean of a texture over a parallelogram.
#pragma once

#include <span>

#include "preprocess/texture/textures.h"
#include "preprocess/texture/tile_cache.h"

namespace farcell {

// Trilinear probes along the longer axis of the parallelogram's ellipse (McCormack, Perry, Farkas, Jouppi, Feline: Fast
// Elliptical Lines for Anisotropic Texture Mapping, 1999), as many as its axes ask for, at most this:
inline constexpr int kMaxProbes = 4;

class PyramidSampler final : public TextureSampler {
 public:
  // Both must outlive the sampler. tiles: may be null when there are no pyramids.
  PyramidSampler(std::span<const Pyramid> pyramids, const ScratchFile* tiles) : pyramids_(pyramids), tiles_(tiles) {}

  glm::vec4 sample(const TextureLookup& lookup) override;
  SurfaceKind surface(uint32_t texture) const override;
  TextureShape shape(uint32_t texture) const override;
  const std::optional<Error>& failure() const override { return tiles_.failure(); }

 private:
  // Colours times alpha, and alpha.
  glm::vec4 probe(const Pyramid& pyramid, glm::vec2 at, float texelEdge);
  glm::vec4 bilinear(const Pyramid& pyramid, const PyramidLevel& level, glm::vec2 at);
  uint32_t pixel(const Pyramid& pyramid, const PyramidLevel& level, uint32_t x, uint32_t y);

  std::span<const Pyramid> pyramids_;
  TileCache tiles_;
};

}  // namespace farcell
