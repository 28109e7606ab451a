#include "preprocess/measure/picture.h"

#include <cmath>

#include "cache/base/check.h"

namespace farcell {

Picture pictureOf(const BakedView& baked, int edge) {
  Picture picture(edge);
  for (int row = 0; row < baked.height; ++row) {
    const float* from = baked.rgba.data() + 4 * static_cast<size_t>(row) * static_cast<size_t>(baked.width);
    glm::vec4* to = picture.rgba.data() + static_cast<size_t>(baked.y0 + row) * static_cast<size_t>(edge) + baked.x0;
    for (int column = 0; column < baked.width; ++column, from += 4)
      to[column] = glm::vec4(from[0], from[1], from[2], from[3]);
  }
  return picture;
}

PicturePair takePair(const CellSoup& soup, TextureSampler* textures, glm::vec3 sun, glm::dvec3 direction, int edge,
                     int samples) {
  ViewBaker baker({edge, samples, sun, false}, textures);
  BakedView front, back;
  baker.begin(viewFrame(direction));
  baker.add(soup);
  baker.finish(front, back);
  return {pictureOf(front, edge), pictureOf(back, edge)};
}

Picture halved(const Picture& picture) {
  FARCELL_CHECK(picture.edge % 2 == 0);
  Picture half(picture.edge / 2);
  for (int y = 0; y < half.edge; ++y) {
    const glm::vec4* low = picture.rgba.data() + 2 * static_cast<size_t>(y) * static_cast<size_t>(picture.edge);
    const glm::vec4* high = low + picture.edge;
    glm::vec4* to = half.rgba.data() + static_cast<size_t>(y) * static_cast<size_t>(half.edge);
    for (int x = 0; x < half.edge; ++x)
      to[x] = 0.25f * ((low[2 * x] + low[2 * x + 1]) + (high[2 * x] + high[2 * x + 1]));
  }
  return half;
}

OwnPixels::OwnPixels(const Picture& alone, const Picture& amongOthers) : edge_(alone.edge) {
  FARCELL_CHECK_EQ(alone.edge, amongOthers.edge);
  std::vector<bool> own(alone.rgba.size());
  for (size_t i = 0; i < own.size(); ++i) own[i] = alone.rgba[i] == amongOthers.rgba[i];
  levels_.push_back(std::move(own));
  for (int edge = edge_ / 2; edge > 0; edge /= 2) {
    const std::vector<bool>& finer = levels_.back();
    std::vector<bool> coarser(static_cast<size_t>(edge) * static_cast<size_t>(edge));
    for (size_t y = 0; y < static_cast<size_t>(edge); ++y)
      for (size_t x = 0; x < static_cast<size_t>(edge); ++x) {
        const size_t first = 4 * y * static_cast<size_t>(edge) + 2 * x, above = first + 2 * static_cast<size_t>(edge);
        coarser[y * static_cast<size_t>(edge) + x] =
            finer[first] && finer[first + 1] && finer[above] && finer[above + 1];
      }
    levels_.push_back(std::move(coarser));
  }
}

bool OwnPixels::at(int edge, int x, int y) const {
  size_t level = 0;
  for (int finest = edge_; finest > edge; finest /= 2) ++level;
  return levels_[level][static_cast<size_t>(y) * static_cast<size_t>(edge) + static_cast<size_t>(x)];
}

void ErrorSum::add(const Picture& truth, const Picture& picture, const OwnPixels& own, int stride) {
  FARCELL_CHECK_EQ(truth.edge, picture.edge);
  for (int y = 0; y < truth.edge; y += stride) {
    for (int x = 0; x < truth.edge; x += stride) {
      if (!own.at(truth.edge, x, y)) continue;
      const size_t i = static_cast<size_t>(y) * static_cast<size_t>(truth.edge) + static_cast<size_t>(x);
      const glm::vec4 d = picture.rgba[i] - truth.rgba[i];
      for (int channel = 0; channel < 3; ++channel)
        error += 255 * std::abs(static_cast<double>(d[channel] - d.w * kMeasureBackground[channel]));
      covered += static_cast<double>(truth.rgba[i].w);
    }
  }
}

}  // namespace farcell
