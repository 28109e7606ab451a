#include "tests/bench/wscg2010/measure/sheet.h"

#include <algorithm>
#include <cstdlib>

#include "cache/base/check.h"

namespace farcell::wscg {
namespace {

constexpr int kShrink = 3;
constexpr int kLinePx = 2;
constexpr uint8_t kLineGrey = 96;

size_t at(const Picture& picture, int x, int y) {
  return 3 * (static_cast<size_t>(y) * static_cast<size_t>(picture.width) + static_cast<size_t>(x));
}

uint8_t meanOf(const Picture& picture, int x, int y, size_t channel) {
  int sum = 0;
  for (int dy = 0; dy < kShrink; ++dy)
    for (int dx = 0; dx < kShrink; ++dx)
      sum += picture.pixels[at(picture, kShrink * x + dx, kShrink * y + dy) + channel];
  return static_cast<uint8_t>((sum + kShrink * kShrink / 2) / (kShrink * kShrink));
}

}  // namespace

Picture pictureOf(const FrameImage& image) {
  return {image.width, image.height, 3, overBackground(image.rgba, {0, 0, 0})};
}

Picture difference(const Picture& a, const Picture& b) {
  FARCELL_CHECK_EQ(a.pixels.size(), b.pixels.size());
  Picture result{a.width, a.height, 3, std::vector<uint8_t>(a.pixels.size())};
  std::transform(a.pixels.begin(), a.pixels.end(), b.pixels.begin(), result.pixels.begin(),
                 [](uint8_t x, uint8_t y) { return static_cast<uint8_t>(std::abs(int{x} - int{y})); });
  return result;
}

Picture contactSheet(const std::vector<Picture>& pictures, int columns) {
  FARCELL_CHECK(!pictures.empty());
  const int width = pictures[0].width / kShrink, height = pictures[0].height / kShrink;
  const int rows = (static_cast<int>(pictures.size()) + columns - 1) / columns;
  Picture sheet{columns * (width + kLinePx) - kLinePx, rows * (height + kLinePx) - kLinePx, 3, {}};
  sheet.pixels.assign(size_t{3} * static_cast<size_t>(sheet.width) * static_cast<size_t>(sheet.height), kLineGrey);
  for (size_t i = 0; i < pictures.size(); ++i) {
    const int left = static_cast<int>(i) % columns * (width + kLinePx);
    const int top = static_cast<int>(i) / columns * (height + kLinePx);
    for (int y = 0; y < height; ++y)
      for (int x = 0; x < width; ++x)
        for (size_t channel = 0; channel < 3; ++channel)
          sheet.pixels[at(sheet, left + x, top + y) + channel] = meanOf(pictures[i], x, y, channel);
  }
  return sheet;
}

}  // namespace farcell::wscg
