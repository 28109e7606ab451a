#include "preprocess/atlas/atlas_sampler.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "cache/base/check.h"
#include "shaders/shared/draw.h"

namespace farcell {
namespace {

struct LevelView {
  const uint8_t* texels;
  int width, height;
  uint32_t channels;

  // Premultiplied.
  glm::vec4 texel(int x, int y) const {
    const auto column = static_cast<size_t>(std::clamp(x, 0, width - 1));
    const auto row = static_cast<size_t>(std::clamp(y, 0, height - 1));
    const uint8_t* from = texels + channels * (row * static_cast<size_t>(width) + column);
    return glm::vec4(from[0], from[1], from[2], channels == 4 ? from[3] : 255) / 255.0f;
  }
};

glm::vec4 mixed(const glm::vec4& a, const glm::vec4& b, float share) { return a + share * (b - a); }

glm::vec4 bilinearAt(const TexturePage& atlas, uint32_t level, glm::vec2 at) {
  const LevelView view{atlas.levels[level].data(), static_cast<int>(atlas.width >> level),
                       static_cast<int>(atlas.height >> level), atlas.channels};
  const float x = at.x * static_cast<float>(view.width) - 0.5f, y = at.y * static_cast<float>(view.height) - 0.5f;
  const float left = std::floor(x), low = std::floor(y);
  const int column = static_cast<int>(left), row = static_cast<int>(low);
  return mixed(mixed(view.texel(column, row), view.texel(column + 1, row), x - left),
               mixed(view.texel(column, row + 1), view.texel(column + 1, row + 1), x - left), y - low);
}

glm::vec4 trilinearAt(const TexturePage& atlas, float level, glm::vec2 at) {
  const float last = static_cast<float>(atlas.levelCount - 1);
  const float within = std::clamp(level, 0.0f, last), whole = std::min(std::floor(within), last);
  const auto finer = static_cast<uint32_t>(whole);
  const glm::vec4 near = bilinearAt(atlas, finer, at);
  return within > whole ? mixed(near, bilinearAt(atlas, finer + 1, at), within - whole) : near;
}

}  // namespace

glm::vec4 AtlasSampler::sample(const TextureLookup& lookup) {
  FARCELL_CHECK(lookup.texture < atlases_.size());
  const TexturePage& atlas = atlases_[lookup.texture];
  const glm::vec2 size(static_cast<float>(atlas.width), static_cast<float>(atlas.height));
  const float across = glm::length(lookup.alongX * size), up = glm::length(lookup.alongY * size);
  const float major = std::max(across, up), minor = std::max(std::min(across, up), 1.0f);
  const float probes = std::clamp(std::ceil(major / minor - 1e-3f), 1.0f, shared::kMostProbes);
  const float level = std::log2(std::max(major, 1e-6f) / probes) + shared::kAtlasLodBias;
  const glm::vec2 axis = across >= up ? lookup.alongX : lookup.alongY;
  glm::vec4 sum(0);
  for (float i = 0; i < probes; ++i) sum += trilinearAt(atlas, level, lookup.at + ((i + 0.5f) / probes - 0.5f) * axis);
  const float share = sum.w / probes;
  return share > 0 ? glm::vec4(glm::vec3(sum) / sum.w, share) : glm::vec4(0);
}

SurfaceKind AtlasSampler::surface(uint32_t texture) const {
  FARCELL_CHECK(texture < atlases_.size());
  return {.alpha = atlases_[texture].channels == 4 ? AlphaMode::blend : AlphaMode::opaque};
}

}  // namespace farcell
