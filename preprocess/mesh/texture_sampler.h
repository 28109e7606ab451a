// Filtered looks at the textures of a mesh: what the pipeline needs of images, whoever reads them.
#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec4.hpp>
#include <optional>

#include "cache/base/result.h"
#include "preprocess/mesh/texture_source.h"

namespace farcell {

// A place on a texture and the parallelogram around it that is averaged, in texture coordinates (mesh_reader.h).
struct TextureLookup {
  uint32_t texture = 0;  // index into MeshReader::textures()
  glm::vec2 at{0};
  glm::vec2 alongX{0}, alongY{0};  // whole sides of the parallelogram; zero: a point
};

// Of its image; no size: there is nothing to look at, it is opaque white everywhere (its image could not be read, or
// it stands only for a side that is seen).
struct TextureShape {
  int width = 0, height = 0;
  TextureWrap wrapU = TextureWrap::repeat, wrapV = TextureWrap::repeat;
};

// For one thread. The same lookup gives the same bits from any sampler of the same textures.
class TextureSampler {
 public:
  virtual ~TextureSampler() = default;
  // R, G, B: mean display values of what is surface there, in [0, 1]: what a vertex colour is multiplied with; 0 where
  // nothing is. A: the share of the parallelogram that is surface; of a mask that is not made smaller 0 or 1. Opaque
  // white, which changes no colour, for a texture that could not be read. Numbers that are not finite are taken as
  // zero.
  virtual glm::vec4 sample(const TextureLookup& lookup) = 0;
  // As the source says; opaque when its image could not be read.
  virtual SurfaceKind surface(uint32_t /*texture*/) const { return {}; }
  virtual TextureShape shape(uint32_t /*texture*/) const { return {}; }
  // Why what was sampled so far cannot be trusted: scratch could not be read.
  virtual const std::optional<Error>& failure() const = 0;
};

}  // namespace farcell
