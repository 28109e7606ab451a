#include "datasets/statue/noise.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace farcell {
namespace {

constexpr float kScale = 1.5f;  // brings its usual range to [-1, 1]; the rare rest is cut off

uint32_t mixedWord(uint32_t h) {
  h ^= h >> 15;
  h *= 0x2c1b3c6du;
  h ^= h >> 12;
  h *= 0x297a2d39u;
  return h ^ h >> 15;
}

// Ten bits of a hash as a gradient's component in [-1, 1).
float component(uint32_t bits) { return static_cast<float>(static_cast<int32_t>(bits & 1023u) - 512) * (1.0f / 512); }

float fade(float t) { return t * t * t * (t * (t * 6 - 15) + 10); }
float mixed(float a, float b, float t) { return a + (b - a) * t; }

}  // namespace

float gradientNoise(uint32_t key, glm::dvec3 place) {
  const glm::dvec3 low(std::floor(place.x), std::floor(place.y), std::floor(place.z));
  const auto part = glm::vec3(place - low);
  const std::array<uint32_t, 3> cell = {static_cast<uint32_t>(static_cast<int32_t>(low.x)),
                                        static_cast<uint32_t>(static_cast<int32_t>(low.y)),
                                        static_cast<uint32_t>(static_cast<int32_t>(low.z))};
  std::array<float, 8> corners;
  for (uint32_t i = 0; i < 8; ++i) {
    const uint32_t x = i & 1, y = i >> 1 & 1, z = i >> 2;
    const uint32_t h =
        mixedWord(key + (cell[0] + x) * 0x9e3779b1u + (cell[1] + y) * 0x85ebca77u + (cell[2] + z) * 0xc2b2ae3du);
    corners[i] = component(h) * (part.x - static_cast<float>(x)) +
                 component(h >> 10) * (part.y - static_cast<float>(y)) +
                 component(h >> 20) * (part.z - static_cast<float>(z));
  }
  const float u = fade(part.x), v = fade(part.y), w = fade(part.z);
  const float lower = mixed(mixed(corners[0], corners[1], u), mixed(corners[2], corners[3], u), v);
  const float upper = mixed(mixed(corners[4], corners[5], u), mixed(corners[6], corners[7], u), v);
  return std::clamp(mixed(lower, upper, w) * kScale, -1.0f, 1.0f);
}

}  // namespace farcell
