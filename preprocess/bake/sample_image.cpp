#include "preprocess/bake/sample_image.h"

#include <algorithm>

#include "cache/base/check.h"

namespace farcell::bake {

void TexelRect::include(const TexelRect& other) {
  x0 = std::min(x0, other.x0);
  y0 = std::min(y0, other.y0);
  x1 = std::max(x1, other.x1);
  y1 = std::max(y1, other.y1);
}

SampleImage::SampleImage(int imageSize_, int samples_, bool withNormals)
    : imageSize(imageSize_), samples(samples_), edgeShift(std::countr_zero(static_cast<unsigned>(samples_)) / 2) {
  FARCELL_CHECK(samples == 1 || samples == 4 || samples == 16 || samples == 64);
  FARCELL_CHECK(imageSize > 0 && imageSize <= kMaxSampleEdge >> edgeShift);
  sampleEdge = imageSize << edgeShift;
  centreIndex = 0.5f * static_cast<float>(sampleEdge - 1);
  const size_t count = size_t(sampleEdge) * size_t(sampleEdge);
  front.assign(count + kKeyPadding, kEmptyFront);
  back.assign(count + kKeyPadding, kEmptyBack);
  if (withNormals) {
    frontNormals.resize(count);
    backNormals.resize(count);
  }
}

void SampleImage::clear() {
  for (int y = touched.y0; y <= touched.y1; ++y) {
    const auto first = (ptrdiff_t(y) * imageSize + touched.x0) * samples;
    const auto count = ptrdiff_t(touched.x1 - touched.x0 + 1) * samples;
    std::fill_n(front.begin() + first, count, kEmptyFront);
    std::fill_n(back.begin() + first, count, kEmptyBack);
  }
  touched = {};
}

}  // namespace farcell::bake
