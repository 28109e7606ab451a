// A finished frame, and how it is laid over a background. Row 0 is the top row.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace farcell {

// RGBA8 premultiplied by coverage, without background: alpha is coverage.
struct FrameImage {
  int width = 0;
  int height = 0;
  std::vector<uint8_t> rgba;
  // Coverage drawn by impostors, at most alpha, 0..255 (1 byte a pixel).
  std::vector<uint8_t> impostorCoverage;
};

// Behind everything unless the user asks for another colour: a plain sky.
inline constexpr std::array<uint8_t, 3> kDefaultBackground = {179, 204, 230};

// RGB, 3 bytes a pixel: colour + (1 - coverage) background, rounded to nearest, in the space of shading.h.
std::vector<uint8_t> overBackground(std::span<const uint8_t> premultipliedRgba, std::array<uint8_t, 3> background);

}  // namespace farcell
