// Colours of OFF files, whose numbers are 0 to 255 or 0 to 1 (off_reader.h says which).
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string_view>

namespace farcell {

struct OffColour {
  std::array<double, 3> channels{};
  bool isWhole = true;  // no point and no exponent in any of them

  bool exceedsOne() const { return channels[0] > 1 || channels[1] > 1 || channels[2] > 1; }
  // 0x00BBGGRR. wholeAreBytes: what rows of whole numbers of this file are.
  uint32_t packed(bool wholeAreBytes) const;
};

// Red, green, blue, and perhaps an alpha. False when one of them is not a number.
bool parseOffColour(std::span<const std::string_view> words, OffColour& colour);

}  // namespace farcell
