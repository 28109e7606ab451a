#include "cache/pack/view_planes.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <memory>
#include <optional>
#include <utility>

#include "cache/base/check.h"
#include "cache/pack/bytes.h"
#include "cache/pack/zlib_stream.h"
#include "cache/schema/model.h"

namespace farcell {
namespace {

enum Plane : uint32_t { kAlpha = 0, kGreen = 1, kRed = 2, kBlue = 3, kDepth = 4, kNormalX = 5 };

constexpr uint32_t kBitsPerFilter = 3;
constexpr uint32_t kFilterMask = (1u << kBitsPerFilter) - 1;
constexpr uint32_t kArrangementShift = 28;
constexpr uint32_t kNormalPlanes = kPlanesWithNormals - kPlanesWithoutNormals;
constexpr int kTrialZlibLevel = 8;       // 12: 0.2 % fewer bytes of a repacked pack, three times the time
constexpr uint32_t kUnitFactorBits = 7;  // a factor of 128: as much as green

using Bytes = std::vector<uint8_t>;

PlaneFilter filterOf(ViewCoding coding, uint32_t plane) {
  return static_cast<PlaneFilter>(coding >> (kBitsPerFilter * plane) & kFilterMask);
}
Arrangement arrangementOf(ViewCoding coding) { return static_cast<Arrangement>(coding >> kArrangementShift); }

// What red or blue is expected to be.
uint8_t fromGreen(uint8_t green, uint8_t factor) {
  return static_cast<uint8_t>(static_cast<uint16_t>(factor * green + (1 << (kUnitFactorBits - 1))) >> kUnitFactorBits);
}

// Which texels of a plane are stored: 255, else 0. Empty: all are.
using Mask = std::span<const uint8_t>;

// Bytes that are all written before they are read.
class Buffer {
 public:
  explicit Buffer(size_t size) : size_(size), bytes_(std::make_unique_for_overwrite<uint8_t[]>(size)) {}
  uint8_t* data() const { return bytes_.get(); }
  std::span<uint8_t> span() const { return {bytes_.get(), size_}; }

 private:
  size_t size_;
  std::unique_ptr<uint8_t[]> bytes_;
};

// The masks of the planes of a view.
class Masks {
 public:
  // Everything is stored.
  Masks() : covered_(0), nearCovered_(0) {}
  // What a sparse arrangement stores. REQUIRES: `alpha` of texels().
  Masks(std::span<const uint8_t> alpha, PlaneSize size) : covered_(size.texels()), nearCovered_(size.texels()) {
    uint8_t* const __restrict covered = covered_.data();
    const uint8_t* const __restrict from = alpha.data();
    for (size_t i = 0; i < size.texels(); ++i) covered[i] = from[i] != 0 ? 255 : 0;
    setNearCovered(size);
  }

  // Alpha is stored everywhere, depth next to covered texels too: it was grown there.
  Mask of(uint32_t plane) const {
    if (plane == kAlpha) return {};
    return plane == kDepth ? nearCovered_.span() : covered_.span();
  }

 private:
  void setNearCovered(PlaneSize size) {
    const size_t width = size.width;
    Bytes rows(width + 2);  // of three rows together, with an empty texel at both ends
    uint8_t* const __restrict sum = rows.data();
    for (size_t y = 0; y < size.height; ++y) {
      const uint8_t* const __restrict row = covered_.data() + y * width;
      const uint8_t* const __restrict below = y > 0 ? row - width : row;
      const uint8_t* const __restrict above = y + 1 < size.height ? row + width : row;
      uint8_t* const __restrict near = nearCovered_.data() + y * width;
      for (size_t x = 0; x < width; ++x) sum[x + 1] = row[x] | below[x] | above[x];
      for (size_t x = 0; x < width; ++x) near[x] = sum[x] | sum[x + 1] | sum[x + 2];
    }
  }

  Buffer covered_, nearCovered_;
};

// The factor of a channel in the sense of least squares.
uint8_t factorOf(std::span<const uint8_t> channel, std::span<const uint8_t> green, PlaneSize size) {
  uint64_t product = 0;
  uint64_t square = 0;
  for (size_t at = 0; at < size.texels(); at += size.width) {
    uint32_t rowProduct = 0, rowSquare = 0;  // a row has less than 65536 texels
    for (size_t i = at; i < at + size.width; ++i) {
      rowProduct += static_cast<uint32_t>(channel[i] * green[i]);
      rowSquare += static_cast<uint32_t>(green[i] * green[i]);
    }
    product += rowProduct;
    square += rowSquare;
  }
  if (square == 0) return 1u << kUnitFactorBits;
  return static_cast<uint8_t>(std::min<uint64_t>(255, ((product << kUnitFactorBits) + square / 2) / square));
}

// The planes one after the other in one block.
class Planes {
 public:
  Planes(uint32_t count, size_t texels) : texels_(texels), bytes_(count * texels) {}
  std::span<uint8_t> operator[](uint32_t index) { return bytes_.span().subspan(index * texels_, texels_); }

 private:
  size_t texels_;
  Buffer bytes_;
};

void splitColours(std::span<const uint8_t> rgba, Planes& planes) {
  uint8_t* const __restrict red = planes[kRed].data();
  uint8_t* const __restrict green = planes[kGreen].data();
  uint8_t* const __restrict blue = planes[kBlue].data();
  uint8_t* const __restrict alpha = planes[kAlpha].data();
  const uint8_t* const __restrict from = rgba.data();
  for (size_t i = 0; i < rgba.size() / 4; ++i) {
    red[i] = from[4 * i];
    green[i] = from[4 * i + 1];
    blue[i] = from[4 * i + 2];
    alpha[i] = from[4 * i + 3];
  }
}

void subtractGreen(std::span<uint8_t> plane, std::span<const uint8_t> green, uint8_t factor) {
  uint8_t* const __restrict to = plane.data();
  const uint8_t* const __restrict from = green.data();
  for (size_t i = 0; i < plane.size(); ++i) to[i] = static_cast<uint8_t>(to[i] - fromGreen(from[i], factor));
}

void addGreen(std::span<uint8_t> plane, std::span<const uint8_t> green, uint8_t factor) {
  uint8_t* const __restrict to = plane.data();
  const uint8_t* const __restrict from = green.data();
  for (size_t i = 0; i < plane.size(); ++i) to[i] = static_cast<uint8_t>(to[i] + fromGreen(from[i], factor));
}

struct ExtractedView {
  Planes planes;  // the channels
  ColourFactors factors;
};

ExtractedView extracted(const ViewImage& view, uint32_t planeCount, PlaneSize size,
                        const std::optional<ColourFactors>& factors) {
  ExtractedView result{Planes(planeCount, size.texels()), {}};
  Planes& planes = result.planes;
  splitColours(view.rgba, planes);
  result.factors = factors ? *factors
                           : ColourFactors{factorOf(planes[kRed], planes[kGreen], size),
                                           factorOf(planes[kBlue], planes[kGreen], size)};
  std::copy(view.depth.begin(), view.depth.end(), planes[kDepth].begin());
  for (uint32_t k = 0; kNormalX + k < planeCount; ++k)
    for (size_t i = 0; i < size.texels(); ++i) planes[kNormalX + k][i] = view.normal[kNormalPlanes * i + k];
  return result;
}

bool zeroOutside(std::span<const uint8_t> plane, Mask mask) {
  uint8_t outside = 0;
  for (size_t i = 0; i < plane.size(); ++i) outside |= static_cast<uint8_t>(plane[i] & ~mask[i]);
  return outside == 0;
}

// The value of all stored texels into `value`; true when there is one. Of none it is 0.
bool isConstant(std::span<const uint8_t> plane, Mask mask, uint8_t& value) {
  const auto first = std::find(mask.begin(), mask.end(), 255);
  value = first == mask.end() ? uint8_t{0} : plane[static_cast<size_t>(first - mask.begin())];
  uint8_t different = 0;
  for (size_t i = 0; i < plane.size(); ++i) different |= static_cast<uint8_t>((plane[i] ^ value) & mask[i]);
  return different == 0;
}

// What the texels of a channel may become.
struct ChannelBounds {
  Buffer low, room;
  PlaneBounds bounds() const { return {low.span(), room.span()}; }
};

// `range(i)` is the lowest and the highest that texel i may have.
template <class Range>
ChannelBounds boundsOf(std::span<const uint8_t> channel, int maxError, const Range& range) {
  ChannelBounds bounds{Buffer(channel.size()), Buffer(channel.size())};
  for (size_t i = 0; i < channel.size(); ++i) {
    const auto [lowest, highest] = range(i);
    const int low = std::max(channel[i] - maxError, lowest), high = std::min(channel[i] + maxError, highest);
    bounds.low.span()[i] = static_cast<uint8_t>(low);
    bounds.room.span()[i] = static_cast<uint8_t>(high - low);
  }
  return bounds;
}

using Range = std::pair<int, int>;

// `alpha` is the coverage as it was moved.
ChannelBounds boundsOf(uint32_t index, std::span<const uint8_t> channel, std::span<const uint8_t> alpha, int maxError) {
  const auto ofAlpha = [&](size_t i) {
    const int value = channel[i];
    return value == 0 || value == 255 ? Range(value, value) : Range(1, 254);
  };
  // A colour above its coverage, which no baker makes, has only its own bound.
  const auto ofColour = [&](size_t i) { return Range(0, channel[i] - maxError <= alpha[i] ? alpha[i] : 255); };
  const auto ofDepth = [&](size_t i) { return channel[i] == 0 ? Range(0, 0) : Range(1, 255); };
  if (index == kAlpha) return boundsOf(channel, maxError, ofAlpha);
  if (index == kDepth) return boundsOf(channel, maxError, ofDepth);
  if (index < kDepth) return boundsOf(channel, maxError, ofColour);
  return boundsOf(channel, maxError, [](size_t) { return Range(0, 255); });
}

// The planes of a view on their way to bytes: channel by channel, each after those that it follows.
class PlaneCoder {
 public:
  PlaneCoder(ExtractedView view, uint32_t planeCount, PlaneSize size, Arrangement arrangement,
             const ArrangeOptions& options)
      : planes_(std::move(view.planes)),
        factors_(view.factors),
        size_(size),
        sparse_(arrangement == Arrangement::sparse),
        options_(options),
        all_(size.texels(), 255) {
    if (sparse_) masks_ = Masks(planes_[kAlpha], size);
    out_.bytes.reserve(arrangedBytesLimit(planeCount, size.texels()));
    for (const uint8_t factor : factors_) out_.u8(factor);
    coding_ = static_cast<uint32_t>(arrangement) << kArrangementShift;
  }

  // False when it is not 0 where the arrangement has no texel.
  bool add(uint32_t index) {
    const std::span<uint8_t> plane = planes_[index];
    const Mask mask = masks_.of(index).empty() ? Mask(all_) : masks_.of(index);
    if (!zeroOutside(plane, mask)) return false;
    std::optional<ChannelBounds> bounds;
    if (options_.maxError > 0) bounds = boundsOf(index, plane, planes_[kAlpha], options_.maxError);
    if (index == kRed || index == kBlue) {
      const uint8_t factor = factors_[index - kRed];
      subtractGreen(plane, planes_[kGreen], factor);
      if (bounds) subtractGreen(bounds->low.span(), planes_[kGreen], factor);
    }
    PlaneFilter filter = likely(index, mask);
    if (bounds) move(index, filter, bounds->bounds(), mask);
    uint8_t value = 0;
    if (sparse_ && isConstant(plane, mask, value)) {
      filter = PlaneFilter::constant;
      out_.u8(value);
    } else {
      if (options_.triesFilters) filter = smallest(index, mask);
      const Bytes values = residualsOf(index, filter, mask);
      out_.append(std::as_bytes(std::span(values)));
    }
    coding_ |= static_cast<uint32_t>(filter) << (kBitsPerFilter * index);
    return true;
  }

  ArrangedView finish() { return {std::move(out_.bytes), coding_}; }

 private:
  PlaneFilter likely(uint32_t index, Mask mask) {
    if (index != kGreen) return likelyFilter(planes_[index], mask, size_);
    Bytes whole(size_.texels());  // where a colour is what is predicted
    for (size_t i = 0; i < whole.size(); ++i) whole[i] = planes_[kAlpha][i] == 255 ? 255 : 0;
    return likelyFilter(planes_[kGreen], whole, size_);
  }

  void move(uint32_t index, PlaneFilter filter, PlaneBounds bounds, Mask mask) {
    const int step = 2 * options_.maxError + 1;
    if (index == kGreen)
      moveColours(filter, bounds, step, planes_[kAlpha], mask, size_, planes_[kGreen]);
    else
      moveTexels(filter, bounds, step, mask, size_, planes_[index]);
  }

  Bytes residualsOf(uint32_t index, PlaneFilter filter, Mask mask) {
    return index == kGreen ? colourResiduals(filter, planes_[kGreen], planes_[kAlpha], mask, size_)
                           : residuals(filter, planes_[index], mask, size_);
  }

  // The filter whose residuals alone deflate best.
  PlaneFilter smallest(uint32_t index, Mask mask) {
    std::array<size_t, static_cast<size_t>(PlaneFilter::constant)> sizes;
    for (size_t i = 0; i < sizes.size(); ++i) {
      const Bytes values = residualsOf(index, static_cast<PlaneFilter>(i), mask);
      sizes[i] = zlibCompress(std::as_bytes(std::span(values)), kTrialZlibLevel).size();
    }
    return static_cast<PlaneFilter>(std::min_element(sizes.begin(), sizes.end()) - sizes.begin());
  }

  Planes planes_;
  const ColourFactors factors_;
  const PlaneSize size_;
  const bool sparse_;
  const ArrangeOptions& options_;
  const Bytes all_;
  Masks masks_;
  ByteWriter out_;
  ViewCoding coding_ = 0;
};

// Stored texels to their places, 0 elsewhere; false when there are fewer.
bool expand(ByteReader& in, Mask mask, std::span<uint8_t> plane) {
  if (mask.empty()) {
    const std::span<const std::byte> stored = in.take(plane.size());
    std::copy_n(reinterpret_cast<const uint8_t*>(stored.data()), stored.size(), plane.data());
    return in.ok();
  }
  const auto* const stored = reinterpret_cast<const uint8_t*>(in.rest().data());
  const size_t count = in.remaining();
  size_t used = 0;
  // Eight at a time, as long as so many are left: most lie inside the mask or outside.
  constexpr size_t kChunk = 8;
  size_t i = 0;
  for (; i + kChunk <= plane.size() && used + kChunk <= count; i += kChunk) {
    uint64_t chunk = 0;
    std::memcpy(&chunk, mask.data() + i, kChunk);
    if (chunk == 0 || chunk == ~uint64_t{0}) {
      uint64_t texels = 0;
      std::memcpy(&texels, stored + used, kChunk);
      texels &= chunk;
      std::memcpy(plane.data() + i, &texels, kChunk);
      used += chunk & kChunk;
    } else {
      for (size_t k = i; k < i + kChunk; ++k) {
        plane[k] = stored[used] & mask[k];
        used += mask[k] & 1;
      }
    }
  }
  for (; i < plane.size(); ++i) {
    if (mask[i] != 0 && used == count) return false;
    plane[i] = mask[i] != 0 ? stored[used++] : uint8_t{0};
  }
  in.take(used);
  return true;
}

bool readPlane(ByteReader& in, uint32_t index, PlaneFilter filter, std::span<const uint8_t> alpha, Mask mask,
               PlaneSize size, std::span<uint8_t> plane) {
  if (filter == PlaneFilter::constant) {
    const uint8_t value = in.u8();
    for (size_t i = 0; i < plane.size(); ++i) plane[i] = mask.empty() ? value : value & mask[i];
    return in.ok();
  }
  if (!expand(in, mask, plane)) return false;
  if (index == kGreen) {
    undoColourFilter(filter, plane, alpha, size);
    return true;
  }
  undoFilter(filter, plane, size);
  if (filter != PlaneFilter::none)
    for (size_t i = 0; i < mask.size(); ++i) plane[i] &= mask[i];
  return true;
}

void joinColours(Planes& planes, std::span<uint8_t> rgba) {
  const uint8_t* const __restrict red = planes[kRed].data();
  const uint8_t* const __restrict green = planes[kGreen].data();
  const uint8_t* const __restrict blue = planes[kBlue].data();
  const uint8_t* const __restrict alpha = planes[kAlpha].data();
  uint8_t* const __restrict out = rgba.data();
  for (size_t i = 0; i < rgba.size() / 4; ++i) {
    out[4 * i] = red[i];
    out[4 * i + 1] = green[i];
    out[4 * i + 2] = blue[i];
    out[4 * i + 3] = alpha[i];
  }
}

}  // namespace

ColourFactors factorsOfArranged(std::span<const std::byte> bytes) {
  FARCELL_CHECK(bytes.size() >= 2);
  return {std::to_integer<uint8_t>(bytes[0]), std::to_integer<uint8_t>(bytes[1])};
}

bool codingValid(ViewCoding coding, uint32_t planeCount) {
  if (coding >> kArrangementShift > static_cast<uint32_t>(Arrangement::sparse)) return false;
  const bool sparse = arrangementOf(coding) == Arrangement::sparse;
  const uint32_t filters = coding & ((1u << kArrangementShift) - 1);
  if (filters >> (kBitsPerFilter * planeCount) != 0) return false;
  for (uint32_t plane = 0; plane < planeCount; ++plane) {
    const auto filter = static_cast<uint32_t>(filterOf(coding, plane));
    if (filter >= kPlaneFilterCount) return false;
    if (filter == static_cast<uint32_t>(PlaneFilter::constant) && !sparse) return false;
  }
  return true;
}

ArrangedView arrangedFromView(const ViewImage& image, uint32_t planeCount, Arrangement wanted,
                              const ArrangeOptions& options) {
  const PlaneSize size{image.width, image.height};
  FARCELL_CHECK_EQ(image.rgba.size(), 4 * size.texels());
  FARCELL_CHECK_EQ(image.depth.size(), size.texels());
  FARCELL_CHECK_EQ(image.normal.size(), planeCount == kPlanesWithNormals ? kNormalPlanes * size.texels() : 0);
  FARCELL_CHECK(options.maxError >= 0 && options.maxError <= kMaxViewError);
  PlaneCoder coder(extracted(image, planeCount, size, options.factors), planeCount, size, wanted, options);
  for (uint32_t i = 0; i < planeCount; ++i)
    if (!coder.add(i)) return arrangedFromView(image, planeCount, Arrangement::plain, options);
  return coder.finish();
}

Result<> viewFromArranged(std::span<const std::byte> bytes, uint32_t planeCount, ViewCoding coding, ViewImage& view) {
  const PlaneSize size{view.width, view.height};
  const size_t texels = size.texels();
  ByteReader in(bytes);
  const ColourFactors factors{in.u8(), in.u8()};
  Planes planes(planeCount, texels);
  const auto read = [&](uint32_t i, const Masks& masks) {
    return readPlane(in, i, filterOf(coding, i), planes[kAlpha], masks.of(i), size, planes[i]);
  };
  bool whole = read(kAlpha, Masks());
  const Masks masks = arrangementOf(coding) == Arrangement::sparse ? Masks(planes[kAlpha], size) : Masks();
  for (uint32_t i = kGreen; i < planeCount; ++i) whole = whole && read(i, masks);
  if (!whole || in.remaining() != 0)
    return fail(ErrorKind::corrupt, "expected the planes of {} x {} texels, found {} bytes", size.width, size.height,
                bytes.size());

  addGreen(planes[kRed], planes[kGreen], factors[0]);
  addGreen(planes[kBlue], planes[kGreen], factors[1]);
  view.rgba.resize(4 * texels);
  joinColours(planes, view.rgba);
  view.depth.assign(planes[kDepth].begin(), planes[kDepth].end());
  view.normal.resize((planeCount - kPlanesWithoutNormals) * texels);
  for (uint32_t k = 0; kNormalX + k < planeCount; ++k)
    for (size_t i = 0; i < texels; ++i) view.normal[kNormalPlanes * i + k] = planes[kNormalX + k][i];
  return {};
}

}  // namespace farcell
