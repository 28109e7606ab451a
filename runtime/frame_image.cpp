#include "runtime/frame_image.h"

#include <algorithm>

#include "cache/base/check.h"

namespace farcell {

std::vector<uint8_t> overBackground(std::span<const uint8_t> premultipliedRgba, std::array<uint8_t, 3> background) {
  FARCELL_CHECK(premultipliedRgba.size() % 4 == 0);
  std::vector<uint8_t> result(premultipliedRgba.size() / 4 * 3);
  for (size_t pixel = 0; pixel < premultipliedRgba.size() / 4; ++pixel) {
    const int clear = 255 - premultipliedRgba[4 * pixel + 3];
    for (size_t channel = 0; channel < 3; ++channel) {
      const int behind = (background[channel] * clear + 127) / 255;
      result[3 * pixel + channel] =
          static_cast<uint8_t>(std::min(255, premultipliedRgba[4 * pixel + channel] + behind));
    }
  }
  return result;
}

}  // namespace farcell
