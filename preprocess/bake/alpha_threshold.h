// How little alpha a sample may have to be surface: what makes coverage of transparency (Wyman, McGuire, Hashed Alpha
// Testing, 2017), stratified over the samples of a texel.
//
// The samples of a texel that one surface covers have thresholds (0 + u) / S, (1 + u) / S, ... in an order of their
// own: a single surface gets its alpha to 1 / S, and the right mean. Order and u are a hash of the texel and of where
// the surface's plane passes it. So surfaces above each other have thresholds that know nothing of each other - the
// mean of their samples is what blending them in order gives - and pieces of one surface, however it was cut, share
// theirs.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "cache/schema/view_frame.h"
#include "preprocess/bake/sample_image.h"

namespace farcell::bake {

// A sample of an image; of a view and of its antipode the same one is the same sample.
struct SamplePlace {
  int column = 0, row = 0;  // of its texel
  int x = 0, y = 0;         // in its texel
};

inline SamplePlace samplePlace(uint32_t element, const SampleImage& image) {
  const int texel = static_cast<int>(element) / image.samples, inTexel = static_cast<int>(element) % image.samples;
  const int edge = 1 << image.edgeShift;
  return {texel % image.imageSize, texel / image.imageSize, inTexel % edge, inTexel / edge};
}

// As seen from the antipode.
inline SamplePlace mirrored(SamplePlace place, const SampleImage& image) {
  place.column = image.imageSize - 1 - place.column;
  place.x = (1 << image.edgeShift) - 1 - place.x;
  return place;
}

// Every change of a bit changes half of the others (Ettinger, Prospecting for Hash Functions: "lowbias32").
inline uint32_t mixed(uint32_t value) {
  value ^= value >> 16;
  value *= 0x7feb352du;
  value ^= value >> 15;
  value *= 0x846ca68bu;
  return value ^ value >> 16;
}

// Element i of a permutation of `count` numbers, a power of two (Kensler, Correlated Multi-Jittered Sampling, 2013).
inline uint32_t permuted(uint32_t i, uint32_t count, uint32_t key) {
  const uint32_t mask = count - 1;
  i ^= key;
  i *= 0xe170893du;
  i ^= key >> 16;
  i ^= (i & mask) >> 4;
  i ^= key >> 8;
  i *= 0x0929eb3fu;
  i ^= key >> 23;
  i ^= (i & mask) >> 1;
  i *= 1 | key >> 27;
  i *= 0x6935fa69u;
  i ^= (i & mask) >> 11;
  i *= 0x74dcb303u;
  i ^= (i & mask) >> 2;
  i *= 0x9e501cc3u;
  i ^= (i & mask) >> 2;
  i *= 0xc860a3dfu;
  return (i + key) & mask;
}

// In [0, 1): a sample is surface where its alpha is greater. planeW: the depth of the surface's plane in the middle of
// the texel, half sides of the cell; anything where the plane is seen edge-on.
inline float alphaThreshold(const SamplePlace& place, float planeW, const SampleImage& image) {
  constexpr float kCellsPerTexel = 4;  // surfaces that are closer than this share thresholds
  constexpr float kMaxCells = 1 << 24;
  const float cells = planeW * (kCellsPerTexel / static_cast<float>(texelSize(image.imageSize)));
  const auto depth =
      std::isfinite(cells) ? static_cast<int32_t>(std::clamp(std::floor(cells), -kMaxCells, kMaxCells)) : 0;
  const uint32_t key = mixed(mixed(mixed(static_cast<uint32_t>(place.column)) + static_cast<uint32_t>(place.row)) +
                             static_cast<uint32_t>(depth));
  const auto samples = static_cast<uint32_t>(image.samples);
  const uint32_t rank = permuted(static_cast<uint32_t>((place.y << image.edgeShift) + place.x), samples, key);
  constexpr float kUnit = 1.0f / 65536;  // few enough bits that no sum is rounded up to 1
  return (static_cast<float>(rank) + static_cast<float>(mixed(key) >> 16) * kUnit) / static_cast<float>(samples);
}

}  // namespace farcell::bake
