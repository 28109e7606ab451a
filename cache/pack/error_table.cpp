#include "cache/pack/error_table.h"

#include <algorithm>
#include <cmath>

namespace farcell {
namespace {

constexpr double kCodesPerOctave = 16;
constexpr double kCodeOfOne = 161;
constexpr double kOctavesBeyond = 3;

}  // namespace

uint8_t codeFromError(double error) {
  const double code = std::round(std::log2(std::max(error, 1e-9)) * kCodesPerOctave + kCodeOfOne);
  return static_cast<uint8_t>(std::clamp(code, 1.0, 255.0));
}

double errorFromCode(uint8_t code) { return code == 0 ? 0 : std::exp2((code - kCodeOfOne) / kCodesPerOctave); }

double expectedError(const ErrorTable& table, ErrorWay way, double texelPixels) {
  const auto& codes = table.codes[static_cast<size_t>(way)];
  const double last = kErrorScales - 1;
  const double scale = std::clamp(std::log2(texelPixels / kErrorTexelPixels[0]), 0.0, last + kOctavesBeyond);
  const auto below = static_cast<size_t>(std::min(scale, last - 1));
  const double part = scale - static_cast<double>(below);
  return std::exp2((codes[below] * (1 - part) + codes[below + 1] * part - kCodeOfOne) / kCodesPerOctave);
}

}  // namespace farcell
