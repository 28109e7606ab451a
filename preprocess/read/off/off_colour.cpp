#include "preprocess/read/off/off_colour.h"

#include "preprocess/mesh/number_text.h"
#include "preprocess/mesh/vertices.h"

namespace farcell {

uint32_t OffColour::packed(bool wholeAreBytes) const {
  const double full = isWhole && wholeAreBytes ? 255 : 1;
  return packColour(channels[0] / full, channels[1] / full, channels[2] / full);
}

bool parseOffColour(std::span<const std::string_view> words, OffColour& colour) {
  colour.isWhole = true;
  for (size_t i = 0; i < words.size(); ++i) {
    double value = 0;
    if (!parseNumber(words[i], value)) return false;
    int64_t whole = 0;
    colour.isWhole &= parseInteger(words[i], whole);
    if (i < colour.channels.size()) colour.channels[i] = value;
  }
  return true;
}

}  // namespace farcell
