#include "tools/evaluate/reference/whole_textures.h"

#include <algorithm>
#include <cmath>
#include <glm/vec3.hpp>

#include "cache/base/interrupt.h"

namespace farcell {
namespace {

// The pixel that stands for one beyond the edges, in whichever of the repetitions it lies.
int pixelWithin(double index, int size, TextureWrap wrap) {
  if (wrap == TextureWrap::clamp) return static_cast<int>(std::clamp(index, 0.0, size - 1.0));
  const double repetition = std::floor(index / size);
  const int within = static_cast<int>(index - repetition * size);
  const bool turned = wrap == TextureWrap::mirror && std::fmod(repetition, 2.0) != 0;
  return turned ? size - 1 - within : within;
}

glm::dvec3 channels(uint32_t pixel) { return glm::dvec3(pixel & 255, pixel >> 8 & 255, pixel >> 16 & 255); }

}  // namespace

Result<WholeTextures> WholeTextures::read(std::span<const TextureSource> sources) {
  WholeTextures whole;
  for (const TextureSource& source : sources) {
    FARCELL_TRY(checkInterrupt());
    Result<TextureImage> image = readTextureImage(source);
    Texture texture{image ? std::move(*image) : TextureImage{}, source.wrapU, source.wrapV, source.surface};
    if (!image) texture.surface.alpha = AlphaMode::opaque;
    whole.textures_.push_back(std::move(texture));
  }
  return whole;
}

glm::vec4 WholeTextures::colourAt(uint32_t index, glm::vec2 at) const {
  const auto& [image, wrapU, wrapV, surface] = textures_[index];
  if (image.pixels.empty() || !std::isfinite(at.x) || !std::isfinite(at.y)) return glm::vec4(1);
  const double x = double{at.x} * image.width - 0.5, y = (1 - double{at.y}) * image.height - 0.5;
  glm::dvec3 sum(0);
  double alpha = 0;
  for (const double row : {std::floor(y), std::floor(y) + 1}) {
    for (const double column : {std::floor(x), std::floor(x) + 1}) {
      const auto pixel = static_cast<size_t>(pixelWithin(row, image.height, wrapV)) * static_cast<size_t>(image.width) +
                         static_cast<size_t>(pixelWithin(column, image.width, wrapU));
      const double weight = (1 - std::abs(x - column)) * (1 - std::abs(y - row)) * (image.pixels[pixel] >> 24) / 255.0;
      sum += weight * channels(image.pixels[pixel]);
      alpha += weight;
    }
  }
  if (surface.alpha == AlphaMode::opaque) return glm::vec4(glm::vec3(sum / 255.0), 1);
  const bool isHole = alpha == 0 || (surface.alpha == AlphaMode::mask && alpha < double{surface.cutoff});
  if (isHole) return glm::vec4(0);
  return glm::vec4(glm::vec3(sum / (255.0 * alpha)), surface.alpha == AlphaMode::mask ? 1 : static_cast<float>(alpha));
}

}  // namespace farcell
