#include "datasets/statue/stone.h"

#include <algorithm>
#include <cmath>

#include "datasets/random/random.h"
#include "datasets/statue/noise.h"

namespace farcell {
namespace {

constexpr double kFirstFrequency = 9;  // of the widest layer, per diagonal
constexpr int kMaxLayers = 24;
constexpr double kBillow = 0.45;  // share of rounded lumps with grooves between them in plain noise
constexpr double kCavityFade = 0.75;
constexpr double kStainFrequency = 5;
constexpr uint32_t kLayerKey = 0x632be5abu;

// One layer for each halving down to the finest width.
int layersFor(double finest) {
  int layers = 1;
  while (layers < kMaxLayers && 1 / std::ldexp(kFirstFrequency, layers) > finest) ++layers;
  return layers;
}

}  // namespace

Stone::Stone(const StoneSettings& settings)
    : settings_(settings), key_(static_cast<uint32_t>(keyOf(settings.seed, 1))), layers_(layersFor(settings.finest)) {}

// A multifractal (Musgrave, in Ebert et al., Texturing and Modeling, 2003): where a layer is low the finer ones are
// weak, so that grooves stay smooth and ridges are rough. Heights are divided by the sum of all layers to infinity: a
// finer statue adds to a coarse one and changes nothing of it.
StonePoint Stone::at(glm::dvec3 place) const {
  double height = 0, cavity = 0;
  double share = 1 - settings_.roughness;
  double cavityShare = 1 - kCavityFade;
  double weight = 1;
  double frequency = kFirstFrequency;
  for (int layer = 0; layer < layers_; ++layer) {
    const double noise = gradientNoise(key_ + kLayerKey * static_cast<uint32_t>(layer), place * frequency);
    const double signal = (noise + (2 * std::abs(noise) - 1) * kBillow) / (1 + kBillow);
    height += signal * weight * share;
    cavity += signal * weight * cavityShare;
    weight = std::clamp(weight * (1.15 + 1.3 * signal), 0.25, 1.0);
    share *= settings_.roughness;
    cavityShare *= kCavityFade;
    frequency *= 2;
  }
  return {height * settings_.amplitude, std::clamp(2.5 * cavity + 0.35, -1.0, 1.0)};
}

std::array<uint8_t, 3> Stone::colour(std::array<uint8_t, 3> albedo, glm::dvec3 place, double cavity) const {
  const double stain = gradientNoise(key_ ^ kLayerKey, place * kStainFrequency);
  const double light = 0.86 + 0.24 * cavity;
  // Lichen takes blue away, soot a little of all.
  const std::array<double, 3> tint = {1 + 0.05 * stain, 1 + 0.03 * stain, 1 - 0.08 * stain};
  std::array<uint8_t, 3> result;
  for (size_t i = 0; i < 3; ++i)
    result[i] = static_cast<uint8_t>(std::clamp(albedo[i] * light * tint[i] + 0.5, 0.0, 255.0));
  return result;
}

}  // namespace farcell
