// Looks at atlases as the GPU does: between texels and levels, several probes along a footprint that is longer than
// wide.
#pragma once

#include <vector>

#include "cache/pack/pages.h"
#include "preprocess/mesh/texture_sampler.h"

namespace farcell {

class AtlasSampler final : public TextureSampler {
 public:
  // TextureLookup::texture is an index into these, its coordinates are those of GeometryPage. They hold all levels.
  explicit AtlasSampler(std::vector<TexturePage> atlases) : atlases_(std::move(atlases)) {}

  // Other atlases from now on.
  void show(std::vector<TexturePage> atlases) { atlases_ = std::move(atlases); }

  glm::vec4 sample(const TextureLookup& lookup) override;
  // Of an atlas with alpha: the share that it says is seen, of masks too, which have holes in it.
  SurfaceKind surface(uint32_t texture) const override;
  const std::optional<Error>& failure() const override { return none_; }

 private:
  std::vector<TexturePage> atlases_;
  std::optional<Error> none_;
};

}  // namespace farcell
