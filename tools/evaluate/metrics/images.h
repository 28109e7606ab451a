// The two pictures that are compared. Row 0 is the top row; values are display values (shaders/shared/shading.h), and
// every average of samples is taken in that space.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace farcell {

using Colour = std::array<float, 3>;  // R, G, B in 0-255

// The truth: full geometry, many samples a pixel.
struct ReferenceImage {
  int width = 0;
  int height = 0;
  std::vector<float> rgb;       // 3 a pixel, 0-255, mean over all samples: premultiplied by coverage
  std::vector<float> coverage;  // 1 a pixel, share of samples that hit something, [0, 1]
};

// A renderer's picture, as it comes from the frame buffer.
struct TestImage {
  int width = 0;
  int height = 0;
  std::span<const uint8_t> rgba;              // 4 a pixel, premultiplied by coverage; alpha is coverage
  std::span<const uint8_t> impostorCoverage;  // 1 a pixel: what of alpha impostors drew; empty: nothing
};

// R, G, B of 0-255 over `background`, 3 a pixel.
std::vector<float> composite(const ReferenceImage& image, const Colour& background);
std::vector<float> composite(const TestImage& image, const Colour& background);

}  // namespace farcell
