#include "preprocess/mesh/vertices.h"

#include "cache/schema/model.h"

namespace farcell {
namespace {
uint32_t byteFromUnit(double value) {
  if (!(value > 0)) return 0;
  return value >= 1 ? 255u : static_cast<uint32_t>(value * 255 + 0.5);
}
}  // namespace

uint32_t packColour(double red, double green, double blue) {
  return byteFromUnit(red) | byteFromUnit(green) << 8 | byteFromUnit(blue) << 16;
}

uint32_t defaultColour() {
  return uint32_t{kDefaultAlbedo[0]} | uint32_t{kDefaultAlbedo[1]} << 8 | uint32_t{kDefaultAlbedo[2]} << 16;
}

}  // namespace farcell
