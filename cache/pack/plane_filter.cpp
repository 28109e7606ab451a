#include "cache/pack/plane_filter.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <type_traits>

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

// 2^24 / alpha, rounded up: exact for every dividend below 2^16.
constexpr uint32_t kReciprocalBits = 24;
constexpr auto kReciprocals = [] {
  std::array<uint32_t, 256> result{};
  for (uint32_t alpha = 1; alpha < result.size(); ++alpha)
    result[alpha] = ((1u << kReciprocalBits) + alpha - 1) / alpha;
  return result;
}();
uint8_t unmultiplied(uint8_t product, uint8_t alpha) {
  const uint64_t dividend = product * 255u + alpha / 2u;
  return static_cast<uint8_t>(std::min<uint64_t>(255, dividend * kReciprocals[alpha] >> kReciprocalBits));
}

// Chooses residuals that are multiples of a step.
class Stepper {
 public:
  explicit Stepper(int step) {
    for (int residual = -128; residual < 128; ++residual)
      toMultiple_[static_cast<uint8_t>(residual)] = static_cast<uint8_t>(((-residual) % step + step) % step);
  }
  // The value of `low` to `low + room` whose residual is such a multiple; of none, the one nearest to the prediction.
  uint8_t value(uint8_t low, uint8_t room, uint8_t prediction) const {
    const auto residual = static_cast<uint8_t>(low - prediction);
    const uint8_t more = toMultiple_[residual];
    const uint8_t end = residual < 128 ? uint8_t{0} : room;
    return static_cast<uint8_t>(low + (more <= room ? more : end));
  }

 private:
  std::array<uint8_t, 256> toMultiple_{};  // what a residual lacks to the next multiple
};

constexpr size_t kWord = 8;  // texels of a 64-bit word

uint64_t load(const uint8_t* bytes) {
  uint64_t word = 0;
  std::memcpy(&word, bytes, kWord);
  return word;
}
void store(uint64_t word, uint8_t* bytes) { std::memcpy(bytes, &word, kWord); }

// The running sums of the eight bytes of a word, each modulo 256, on top of `before`. Two lanes of bytes in 16 bits
// each hold what the products carry; a big-endian machine would number the bytes the other way.
uint64_t sums(uint64_t bytes, uint8_t before) {
  static_assert(std::endian::native == std::endian::little);
  constexpr uint64_t kLanes = 0x0001000100010001, kLow = 0x00ff00ff00ff00ff;
  const uint64_t odd = bytes >> 8 & kLow;
  const uint64_t oddSums = ((bytes & kLow) + odd) * kLanes + before * kLanes;
  return ((oddSums - odd) & kLow) | (oddSums & kLow) << 8;
}

// The running sum along a row.
void sumRow(uint8_t* row, size_t width) {
  uint8_t sum = 0;
  size_t x = 0;
  for (; x + kWord <= width; x += kWord) {
    store(sums(load(row + x), sum), row + x);
    sum = row[x + kWord - 1];
  }
  for (; x < width; ++x) sum = row[x] = static_cast<uint8_t>(row[x] + sum);
}

void addRow(const uint8_t* more, uint8_t* row, size_t width) {
  for (size_t x = 0; x < width; ++x) row[x] = static_cast<uint8_t>(row[x] + more[x]);
}

// No texel of the eight is covered in part, and those that are not covered have no residual.
bool allOrNothing(uint64_t residuals, uint64_t alphas) {
  constexpr uint64_t kLowBits = 0x0101010101010101;
  return (alphas & kLowBits) * 255 == alphas && (residuals & ~alphas) == 0;
}

// Undoes the filter of a colour. `row` is what the texels of the row below count as, and becomes that of this row.
template <class Prediction>
class ColourRow {
 public:
  ColourRow(const Prediction& predict, std::span<uint8_t> row) : predict_(predict), row_(row) {}

  void undo(uint8_t* colour, const uint8_t* alpha) {
    left_ = upLeft_ = 0;
    size_t x = 0;
    for (; x + kWord <= row_.size(); x += kWord) {
      const uint64_t alphas = load(alpha + x);
      if (allOrNothing(load(colour + x), alphas))
        undoWhole(x, colour + x, alphas);
      else
        for (size_t i = x; i < x + kWord; ++i) undoTexel(i, colour[i], alpha[i]);
    }
    for (; x < row_.size(); ++x) undoTexel(x, colour[x], alpha[x]);
  }

 private:
  void undoTexel(size_t x, uint8_t& colour, uint8_t alpha) {
    const uint8_t up = row_[x];
    const uint8_t prediction = predict_(left_, up, upLeft_);
    upLeft_ = up;
    if (alpha == 255) {
      left_ = row_[x] = colour = static_cast<uint8_t>(colour + prediction);
      return;
    }
    colour = static_cast<uint8_t>(colour + multiplied(prediction, alpha));
    left_ = row_[x] = alpha != 0 ? unmultiplied(colour, alpha) : prediction;
  }

  // Where nothing is multiplied, a texel counts as its prediction plus its residual, which is 0 where nothing is
  // covered.
  void undoWhole(size_t x, uint8_t* colour, uint64_t alphas) {
    uint8_t* const row = row_.data() + x;
    const uint8_t lastUp = row[kWord - 1];
    if constexpr (std::is_same_v<Prediction, Average>) {
      for (size_t i = 0; i < kWord; ++i)
        left_ = row[i] = static_cast<uint8_t>(colour[i] + predict_(left_, row[i], upLeft_));
    } else if constexpr (std::is_same_v<Prediction, Up>) {
      addRow(colour, row, kWord);
    } else if constexpr (std::is_same_v<Prediction, Gradient>) {
      std::array<uint8_t, kWord> aboveUp;
      store(sums(load(colour), static_cast<uint8_t>(left_ - upLeft_)), aboveUp.data());
      addRow(aboveUp.data(), row, kWord);
    } else if constexpr (std::is_same_v<Prediction, Left>) {
      store(sums(load(colour), left_), row);
    } else {
      store(load(colour), row);
    }
    left_ = row[kWord - 1];
    upLeft_ = lastUp;
    store(load(row) & alphas, colour);
  }

  const Prediction predict_;
  const std::span<uint8_t> row_;
  uint8_t left_ = 0;
  uint8_t upLeft_ = 0;
};

constexpr size_t kPredictionCount = 5;
using FilterCosts = std::array<uint32_t, kPredictionCount>;

uint8_t magnitude(int difference) {
  const auto value = static_cast<uint8_t>(difference);
  return std::min(value, static_cast<uint8_t>(-value));
}

// The magnitudes of the residuals of a row, of the texels that count and whose neighbours do.
FilterCosts costsOfRow(const uint8_t* plane, const uint8_t* weight, size_t width) {
  uint32_t none = 0, up = 0, left = 0, average = 0, gradient = 0;
  const uint8_t* const below = plane - width;
  const uint8_t* const weightBelow = weight - width;
  for (size_t x = 1; x < width; ++x) {
    const uint8_t mask = weight[x] & weight[x - 1] & weightBelow[x];
    none += magnitude(plane[x]) & mask;
    up += magnitude(plane[x] - below[x]) & mask;
    left += magnitude(plane[x] - plane[x - 1]) & mask;
    average += magnitude(plane[x] - (plane[x - 1] + below[x]) / 2) & mask;
    gradient += magnitude(plane[x] - plane[x - 1] - below[x] + below[x - 1]) & mask;
  }
  return {none, up, left, average, gradient};
}

}  // namespace

PlaneFilter likelyFilter(std::span<const uint8_t> plane, std::span<const uint8_t> weight, PlaneSize size) {
  std::array<uint64_t, kPredictionCount> costs{};
  for (size_t y = 1; y < size.height; ++y) {
    const size_t at = y * size.width;
    const FilterCosts row = costsOfRow(plane.data() + at, weight.data() + at, size.width);
    for (size_t i = 0; i < row.size(); ++i) costs[i] += row[i];
  }
  return static_cast<PlaneFilter>(std::min_element(costs.begin(), costs.end()) - costs.begin());
}

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

void moveTexels(PlaneFilter filter, PlaneBounds bounds, int step, std::span<const uint8_t> mask, PlaneSize size,
                std::span<uint8_t> plane) {
  const Stepper stepper(step);
  withPrediction(filter, [&](const auto& predict) {
    walk(predict, size, [&](size_t i, uint8_t prediction) {
      if (mask[i] == 0) return prediction;
      return plane[i] = stepper.value(bounds.low[i], bounds.room[i], prediction);
    });
  });
}

void moveColours(PlaneFilter filter, PlaneBounds bounds, int step, std::span<const uint8_t> alpha,
                 std::span<const uint8_t> mask, PlaneSize size, std::span<uint8_t> colour) {
  const Stepper stepper(step);
  withPrediction(filter, [&](const auto& predict) {
    walk(predict, size, [&](size_t i, uint8_t prediction) {
      if (mask[i] != 0) colour[i] = stepper.value(bounds.low[i], bounds.room[i], multiplied(prediction, alpha[i]));
      return alpha[i] != 0 ? unmultiplied(colour[i], alpha[i]) : prediction;
    });
  });
}

void undoFilter(PlaneFilter filter, std::span<uint8_t> plane, PlaneSize size) {
  if (filter == PlaneFilter::average)
    return walk(Average{}, size,
                [&](size_t i, uint8_t prediction) { return plane[i] = static_cast<uint8_t>(plane[i] + prediction); });
  for (size_t y = 0; y < size.height; ++y) {
    uint8_t* row = plane.data() + y * size.width;
    if (filter == PlaneFilter::left || filter == PlaneFilter::gradient) sumRow(row, size.width);
    if (y > 0 && (filter == PlaneFilter::up || filter == PlaneFilter::gradient))
      addRow(row - size.width, row, size.width);
  }
}

void undoColourFilter(PlaneFilter filter, std::span<uint8_t> colour, std::span<const uint8_t> alpha, PlaneSize size) {
  std::vector<uint8_t> counted(size.width);
  withPrediction(filter, [&](const auto& predict) {
    ColourRow row(predict, counted);
    for (size_t at = 0; at < size.texels(); at += size.width) row.undo(colour.data() + at, alpha.data() + at);
  });
}

}  // namespace farcell
