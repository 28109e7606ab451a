#include "tools/evaluate/metrics/images.h"

#include <cstddef>

namespace farcell {

std::vector<float> composite(const ReferenceImage& image, const Colour& background) {
  std::vector<float> values(image.rgb);
  for (size_t pixel = 0; pixel < image.coverage.size(); ++pixel)
    for (size_t c = 0; c < 3; ++c) values[3 * pixel + c] += (1 - image.coverage[pixel]) * background[c];
  return values;
}

std::vector<float> composite(const TestImage& image, const Colour& background) {
  const size_t pixels = image.rgba.size() / 4;
  std::vector<float> values(3 * pixels);
  for (size_t pixel = 0; pixel < pixels; ++pixel) {
    const float empty = static_cast<float>(255 - image.rgba[4 * pixel + 3]) / 255;
    for (size_t c = 0; c < 3; ++c)
      values[3 * pixel + c] = static_cast<float>(image.rgba[4 * pixel + c]) + empty * background[c];
  }
  return values;
}

}  // namespace farcell
