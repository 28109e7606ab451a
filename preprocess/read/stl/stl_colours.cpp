#include "preprocess/read/stl/stl_colours.h"

#include <string_view>

#include "preprocess/mesh/vertices.h"

namespace farcell {

StlColours::StlColours(std::span<const std::byte, 80> header) : objectColour_(defaultColour()) {
  constexpr std::string_view kMark = "COLOR=";
  const std::string_view text(reinterpret_cast<const char*>(header.data()), header.size());
  const size_t at = text.find(kMark);
  if (at == std::string_view::npos || at + kMark.size() + 4 > text.size()) return;
  isMagics_ = true;
  const auto channel = [&](size_t i) { return std::to_integer<uint32_t>(header[at + kMark.size() + i]); };
  objectColour_ = channel(0) | channel(1) << 8 | channel(2) << 16;
}

uint32_t StlColours::colour(uint16_t attribute) const {
  const bool marked = (attribute & 0x8000u) != 0;
  if (marked == isMagics_) return objectColour_;
  const auto fiveBits = [&](int shift) { return (attribute >> shift & 31) / 31.0; };
  return isMagics_ ? packColour(fiveBits(0), fiveBits(5), fiveBits(10))
                   : packColour(fiveBits(10), fiveBits(5), fiveBits(0));
}

}  // namespace farcell
