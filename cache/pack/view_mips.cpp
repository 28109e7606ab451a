#include "cache/pack/view_mips.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "cache/base/check.h"
#include "shaders/shared/shading.h"

namespace farcell {
namespace {

template <class Value>
std::vector<Value> placed(const std::vector<Value>& cropped, const ViewImage& view, int imageSize, size_t channels) {
  const size_t edge = static_cast<size_t>(imageSize);
  std::vector<Value> image(edge * edge * channels, 0);
  for (size_t y = 0; y < view.height; ++y)
    std::copy_n(cropped.begin() + static_cast<ptrdiff_t>(y * view.width * channels), view.width * channels,
                image.begin() + static_cast<ptrdiff_t>(((view.y0 + y) * edge + view.x0) * channels));
  return image;
}

// Of four, rounded to nearest.
uint8_t mean(int sum, uint8_t) { return static_cast<uint8_t>((sum + 2) / 4); }
int8_t mean(int sum, int8_t) { return static_cast<int8_t>((sum + 4 * 128 + 2) / 4 - 128); }

template <class Value>
std::vector<Value> halved(const std::vector<Value>& image, size_t edge) {
  const size_t half = edge / 2;
  std::vector<Value> result(half * half * 4);
  for (size_t y = 0; y < half; ++y) {
    const Value* low = image.data() + 2 * y * edge * 4;
    const Value* high = low + edge * 4;
    Value* out = result.data() + y * half * 4;
    for (size_t i = 0; i < half * 4; ++i) {
      const size_t j = (i / 4) * 8 + i % 4;
      out[i] = mean(low[j] + low[j + 4] + high[j] + high[j + 4], Value());
    }
  }
  return result;
}

template <class Value>
std::vector<std::vector<Value>> mips(std::vector<Value> finest, int imageSize) {
  std::vector<std::vector<Value>> levels = {std::move(finest)};
  for (int edge = imageSize; edge > 1; edge /= 2) levels.push_back(halved(levels.back(), static_cast<size_t>(edge)));
  return levels;
}

glm::vec3 meanNormal(const uint8_t* octahedral) {
  const glm::vec2 p(static_cast<float>(octahedral[0]) / 127.5f - 1, static_cast<float>(octahedral[1]) / 127.5f - 1);
  return shared::unitFromOctahedral(p) * (static_cast<float>(octahedral[2]) / 255.0f);
}

}  // namespace

int mipLevelCount(int imageSize) { return std::bit_width(static_cast<unsigned>(imageSize)); }

std::vector<std::vector<uint8_t>> buildColourMips(const ViewImage& view, int imageSize) {
  return mips(placed(view.rgba, view, imageSize, 4), imageSize);
}

std::vector<uint8_t> buildDepthImage(const ViewImage& view, int imageSize) {
  return placed(view.depth, view, imageSize, 1);
}

std::vector<std::vector<int8_t>> buildNormalMips(const ViewImage& view, int imageSize) {
  const size_t texels = static_cast<size_t>(view.width) * view.height;
  FARCELL_CHECK_EQ(view.normal.size(), 3 * texels);
  std::vector<int8_t> vectors(4 * texels, 0);
  for (size_t i = 0; i < texels; ++i) {
    const glm::vec3 scaled =
        meanNormal(&view.normal[3 * i]) * (static_cast<float>(view.rgba[4 * i + 3]) * (127.0f / 255));
    for (int axis = 0; axis < 3; ++axis)
      vectors[4 * i + static_cast<size_t>(axis)] = static_cast<int8_t>(std::lround(scaled[axis]));
  }
  return mips(placed(vectors, view, imageSize, 4), imageSize);
}

}  // namespace farcell
