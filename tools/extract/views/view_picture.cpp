#include "tools/extract/views/view_picture.h"

#include <algorithm>

#include "cache/base/check.h"
#include "shaders/shared/shading.h"

namespace farcell {
namespace {

uint8_t byteOf(float value) { return static_cast<uint8_t>(std::clamp(value * 127.5f + 128.0f, 0.0f, 255.0f)); }

void putNormal(const uint8_t* octahedral, uint8_t alpha, uint8_t* out) {
  const glm::vec2 p(static_cast<float>(octahedral[0]) / 127.5f - 1, static_cast<float>(octahedral[1]) / 127.5f - 1);
  const glm::vec3 normal = shared::unitFromOctahedral(p);
  out[0] = byteOf(normal.x);
  out[1] = byteOf(normal.y);
  out[2] = byteOf(normal.z);
  out[3] = alpha;
}

void putTexel(const ViewImage& view, size_t texel, ViewChannel channel, uint8_t* out) {
  const uint8_t* rgba = view.rgba.data() + 4 * texel;
  switch (channel) {
    case ViewChannel::colour:
      for (size_t i = 0; i < 3; ++i) out[i] = withoutAlpha(rgba[i], rgba[3]);
      out[3] = rgba[3];
      break;
    case ViewChannel::coverage:
      out[0] = rgba[3];
      break;
    case ViewChannel::depth:
      out[0] = view.depth[texel];
      break;
    case ViewChannel::normal:
      putNormal(view.normal.data() + 3 * texel, rgba[3], out);
      break;
  }
}

}  // namespace

int channelCount(ViewChannel channel) {
  return channel == ViewChannel::colour || channel == ViewChannel::normal ? 4 : 1;
}

Picture viewPicture(const ViewImage& view, ViewChannel channel) {
  FARCELL_CHECK(view.width > 0 && view.height > 0);
  FARCELL_CHECK(channel != ViewChannel::normal || !view.normal.empty());
  const auto channels = static_cast<size_t>(channelCount(channel));
  Picture picture = blankPicture(static_cast<int>(view.width), static_cast<int>(view.height), channelCount(channel));
  for (size_t row = 0; row < view.height; ++row)
    for (size_t x = 0; x < view.width; ++x) {
      const size_t texel = (view.height - 1 - row) * view.width + x;  // views store their lowest row first
      putTexel(view, texel, channel, picture.pixels.data() + (row * view.width + x) * channels);
    }
  return picture;
}

Picture blankPicture(int width, int height, int channels) {
  return {
      width, height, channels,
      std::vector<uint8_t>(static_cast<size_t>(width) * static_cast<size_t>(height) * static_cast<size_t>(channels))};
}

void place(const Picture& source, int x, int y, Picture& target) {
  FARCELL_CHECK_EQ(source.channels, target.channels);
  FARCELL_CHECK(x >= 0 && y >= 0 && x + source.width <= target.width && y + source.height <= target.height);
  const auto channels = static_cast<size_t>(source.channels);
  const size_t rowBytes = static_cast<size_t>(source.width) * channels;
  for (int row = 0; row < source.height; ++row) {
    const size_t at =
        (static_cast<size_t>(y + row) * static_cast<size_t>(target.width) + static_cast<size_t>(x)) * channels;
    std::copy_n(source.pixels.begin() + static_cast<ptrdiff_t>(static_cast<size_t>(row) * rowBytes), rowBytes,
                target.pixels.begin() + static_cast<ptrdiff_t>(at));
  }
}

}  // namespace farcell
