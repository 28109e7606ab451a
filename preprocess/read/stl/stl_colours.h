// Colours in the two attribute bytes of a binary STL facet, by the two conventions that are in use; they take the red
// and the blue of the same five bits for each other.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace farcell {

class StlColours {
 public:
  // header: the first 80 bytes. "COLOR=" in it, followed by the bytes R, G, B and A, is the mark of Materialise Magics:
  // that is the colour of the object, and bit 15 of a facet says that it has it; else the facet has its own. Without
  // that mark bit 15 says that a facet has a colour at all (VisCAM, SolidView).
  explicit StlColours(std::span<const std::byte, 80> header);

  // Whether every facet has a colour, whatever its attribute.
  bool isMagics() const { return isMagics_; }
  bool hasColour(uint16_t attribute) const { return isMagics_ || (attribute & 0x8000u) != 0; }
  // 0x00BBGGRR; the default albedo without one.
  uint32_t colour(uint16_t attribute) const;

 private:
  bool isMagics_ = false;
  uint32_t objectColour_ = 0;
};

}  // namespace farcell
