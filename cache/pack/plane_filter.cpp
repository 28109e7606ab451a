#include "cache/pack/plane_filter.h"

#include <algorithm>

namespace farcell {
namespace {

// Predictions from the texels to the left, below, and below to the left.
struct None {
  uint8_t operator()(uint8_t, uint8_t, uint8_t) const { return 0; }
};
struct Up {
  uint8_t operator()(uint8_t, uint8_t up, uint8_t) const { return up; }
};
struct Left {
  uint8_t operator()(uint8_t left, uint8_t, uint8_t) const { return left; }
};
struct Average {
  uint8_t operator()(uint8_t left, uint8_t up, uint8_t) const { return static_cast<uint8_t>((left + up) / 2); }
};
struct Gradient {
  uint8_t operator()(uint8_t left, uint8_t up, uint8_t upLeft) const {
    return static_cast<uint8_t>(left + up - upLeft);
  }
};

template <class Visit>
void withPrediction(PlaneFilter filter, const Visit& visit) {
  switch (filter) {
    case PlaneFilter::up:
      return visit(Up{});
    case PlaneFilter::left:
      return visit(Left{});
    case PlaneFilter::average:
      return visit(Average{});
    case PlaneFilter::gradient:
      return visit(Gradient{});
    case PlaneFilter::none:
    case PlaneFilter::constant:
      return visit(None{});
  }
}

// Calls texel(i, prediction) for each texel in order; it returns what the texel counts as for those that follow.
template <class Prediction, class Texel>
void walk(const Prediction& predict, PlaneSize size, const Texel& texel) {
  std::vector<uint8_t> row(size.width);
  size_t i = 0;
  for (size_t y = 0; y < size.height; ++y) {
    uint8_t left = 0;
    uint8_t upLeft = 0;
    for (uint8_t& value : row) {
      const uint8_t up = value;
      left = value = texel(i++, predict(left, up, upLeft));
      upLeft = up;
    }
  }
}

// A colour seen through its coverage, and back. Colours above their coverage, which no baker makes, stay 255.
uint8_t multiplied(uint8_t colour, uint8_t alpha) { return static_cast<uint8_t>((colour * alpha + 127u) / 255u); }
uint8_t unmultiplied(uint8_t product, uint8_t alpha) {
  if (alpha == 255) return product;
  return static_cast<uint8_t>(std::min(255u, (product * 255u + alpha / 2u) / alpha));
}

// The running sum along a row.
void sumRow(uint8_t* row, size_t width) {
  uint8_t sum = 0;
  for (size_t x = 0; x < width; ++x) sum = row[x] = static_cast<uint8_t>(row[x] + sum);
}

void addRowBelow(uint8_t* row, size_t width) {
  const uint8_t* below = row - width;
  for (size_t x = 0; x < width; ++x) row[x] = static_cast<uint8_t>(row[x] + below[x]);
}

}  // namespace

std::vector<uint8_t> residuals(PlaneFilter filter, std::span<const uint8_t> plane, std::span<const uint8_t> mask,
                               PlaneSize size) {
  std::vector<uint8_t> result(size.texels() + 1);
  size_t stored = 0;
  withPrediction(filter, [&](const auto& predict) {
    walk(predict, size, [&](size_t i, uint8_t prediction) {
      result[stored] = static_cast<uint8_t>(plane[i] - prediction);
      stored += mask[i] & 1;
      return mask[i] != 0 ? plane[i] : prediction;
    });
  });
  result.resize(stored);
  return result;
}

std::vector<uint8_t> colourResiduals(PlaneFilter filter, std::span<const uint8_t> colour,
                                     std::span<const uint8_t> alpha, std::span<const uint8_t> mask, PlaneSize size) {
  std::vector<uint8_t> result(size.texels() + 1);
  size_t stored = 0;
  withPrediction(filter, [&](const auto& predict) {
    walk(predict, size, [&](size_t i, uint8_t prediction) {
      result[stored] = static_cast<uint8_t>(colour[i] - multiplied(prediction, alpha[i]));
      stored += mask[i] & 1;
      return alpha[i] != 0 ? unmultiplied(colour[i], alpha[i]) : prediction;
    });
  });
  result.resize(stored);
  return result;
}

void undoFilter(PlaneFilter filter, std::span<uint8_t> plane, PlaneSize size) {
  if (filter == PlaneFilter::average)
    return walk(Average{}, size,
                [&](size_t i, uint8_t prediction) { return plane[i] = static_cast<uint8_t>(plane[i] + prediction); });
  for (size_t y = 0; y < size.height; ++y) {
    uint8_t* row = plane.data() + y * size.width;
    if (filter == PlaneFilter::left || filter == PlaneFilter::gradient) sumRow(row, size.width);
    if (y > 0 && (filter == PlaneFilter::up || filter == PlaneFilter::gradient)) addRowBelow(row, size.width);
  }
}

void undoColourFilter(PlaneFilter filter, std::span<uint8_t> colour, std::span<const uint8_t> alpha, PlaneSize size) {
  withPrediction(filter, [&](const auto& predict) {
    walk(predict, size, [&](size_t i, uint8_t prediction) {
      if (alpha[i] == 255) return colour[i] = static_cast<uint8_t>(colour[i] + prediction);
      colour[i] = static_cast<uint8_t>(colour[i] + multiplied(prediction, alpha[i]));
      return alpha[i] != 0 ? unmultiplied(colour[i], alpha[i]) : prediction;
    });
  });
}

}  // namespace farcell
