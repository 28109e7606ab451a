#include "cache/pack/view_mips.h"

#include <algorithm>
#include <bit>

#include "cache/base/check.h"

namespace farcell {
namespace {

std::vector<uint8_t> placed(const std::vector<uint8_t>& cropped, const ViewImage& view, int imageSize,
                            size_t channels) {
  const size_t edge = static_cast<size_t>(imageSize);
  std::vector<uint8_t> image(edge * edge * channels, 0);
  for (size_t y = 0; y < view.height; ++y)
    std::copy_n(cropped.begin() + static_cast<ptrdiff_t>(y * view.width * channels), view.width * channels,
                image.begin() + static_cast<ptrdiff_t>(((view.y0 + y) * edge + view.x0) * channels));
  return image;
}

std::vector<uint8_t> halved(const std::vector<uint8_t>& image, size_t edge) {
  const size_t half = edge / 2;
  std::vector<uint8_t> result(half * half * 4);
  for (size_t y = 0; y < half; ++y) {
    const uint8_t* low = image.data() + 2 * y * edge * 4;
    const uint8_t* high = low + edge * 4;
    uint8_t* out = result.data() + y * half * 4;
    for (size_t i = 0; i < half * 4; ++i) {
      const size_t j = (i / 4) * 8 + i % 4;
      out[i] = static_cast<uint8_t>((low[j] + low[j + 4] + high[j] + high[j + 4] + 2) / 4);
    }
  }
  return result;
}

}  // namespace

int mipLevelCount(int imageSize) { return std::bit_width(static_cast<unsigned>(imageSize)); }

std::vector<std::vector<uint8_t>> buildColourMips(const ViewImage& view, int imageSize) {
  std::vector<std::vector<uint8_t>> levels = {placed(view.rgba, view, imageSize, 4)};
  for (int edge = imageSize; edge > 1; edge /= 2) levels.push_back(halved(levels.back(), static_cast<size_t>(edge)));
  return levels;
}

std::vector<uint8_t> buildDepthImage(const ViewImage& view, int imageSize) {
  return placed(view.depth, view, imageSize, 1);
}

std::vector<uint8_t> buildNormalImage(const ViewImage& view, int imageSize) {
  FARCELL_CHECK_EQ(view.normal.size(), 2 * static_cast<size_t>(view.width) * view.height);
  return placed(view.normal, view, imageSize, 2);
}

}  // namespace farcell
