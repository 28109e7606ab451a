// What the build measured of a cell, or expects of it from cells that were measured: the image error of each way to
// draw it, by the size of its texels on screen.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace farcell {

// Edge of a texel of the cell's views, pixels.
inline constexpr size_t kErrorScales = 4;
inline constexpr std::array<double, kErrorScales> kErrorTexelPixels = {0.25, 0.5, 1, 2};

enum class ErrorWay : size_t {
  mesh = 0,            // the cell's mesh, at 4 samples a pixel
  depthCorrected = 1,  // its views, kind A
  blended = 2,         // its views, kind B
};
inline constexpr size_t kErrorWays = 3;

// An error is |dR| + |dG| + |dB| a pixel that the cell covers, where 1 is what full geometry at one sample a pixel has
// on average over the model's cells and the four scales.
struct ErrorTable {
  std::array<std::array<uint8_t, kErrorScales>, kErrorWays> codes{};  // of a way that is not there, 0

  bool knows(ErrorWay way) const { return codes[static_cast<size_t>(way)][0] != 0; }
  bool operator==(const ErrorTable&) const = default;
};

// Codes from 1 are 16 to the octave: within 2.2 %, from 2^-10 to 2^5.9.
uint8_t codeFromError(double error);
double errorFromCode(uint8_t code);  // 0 for 0

// Between the scales on a straight line of logarithms, which goes on to texels eight times as large as the last, and
// beyond all that as at its ends. REQUIRES: knows(way).
double expectedError(const ErrorTable& table, ErrorWay way, double texelPixels);

}  // namespace farcell
