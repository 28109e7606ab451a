#include "cache/pack/view_planes.h"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <cstring>

#include "cache/base/check.h"
#include "cache/pack/bytes.h"

namespace farcell {
namespace {

enum Plane : uint32_t { kAlpha = 0, kGreen = 1, kRed = 2, kBlue = 3, kDepth = 4, kNormalX = 5 };

constexpr uint32_t kBitsPerFilter = 4;
constexpr uint32_t kFilterMask = (1u << kBitsPerFilter) - 1;
constexpr uint32_t kArrangementShift = 28;
constexpr uint32_t kUnitFactorBits = 7;  // a factor of 128: as much as green

using Bytes = std::vector<uint8_t>;

PlaneFilter filterOf(ViewCoding coding, uint32_t plane) {
  return static_cast<PlaneFilter>(coding >> (kBitsPerFilter * plane) & kFilterMask);
}
Arrangement arrangementOf(ViewCoding coding) { return static_cast<Arrangement>(coding >> kArrangementShift); }

// What red or blue is expected to be.
uint8_t fromGreen(uint8_t green, uint32_t factor) {
  return static_cast<uint8_t>((factor * green + (1u << (kUnitFactorBits - 1))) >> kUnitFactorBits);
}

// Which texels of the planes are stored: 255, else 0.
class Masks {
 public:
  // REQUIRES for sparse: `alpha` of texels().
  Masks(Arrangement arrangement, std::span<const uint8_t> alpha, PlaneSize size) : all_(size.texels(), 255) {
    if (arrangement == Arrangement::plain) return;
    covered_.resize(size.texels());
    for (size_t i = 0; i < covered_.size(); ++i) covered_[i] = alpha[i] != 0 ? 255 : 0;
    setNearCovered(size);
  }

  // Alpha is stored everywhere, depth next to covered texels too: it was grown there.
  std::span<const uint8_t> of(uint32_t plane) const {
    if (covered_.empty() || plane == kAlpha) return all_;
    return plane == kDepth ? nearCovered_ : covered_;
  }

 private:
  void setNearCovered(PlaneSize size) {
    nearCovered_.resize(size.texels());
    Bytes rows(size.width + 2);  // of three rows together, with an empty texel at both ends
    for (size_t y = 0; y < size.height; ++y) {
      std::fill(rows.begin(), rows.end(), uint8_t{0});
      for (size_t from = y > 0 ? y - 1 : 0; from < std::min(y + 2, size.height); ++from)
        for (size_t x = 0; x < size.width; ++x) rows[x + 1] |= covered_[from * size.width + x];
      for (size_t x = 0; x < size.width; ++x) nearCovered_[y * size.width + x] = rows[x] | rows[x + 1] | rows[x + 2];
    }
  }

  Bytes all_, covered_, nearCovered_;
};

// The factor of a channel in the sense of least squares.
uint8_t factorOf(const ViewImage& view, size_t channel) {
  uint64_t product = 0;
  uint64_t square = 0;
  for (size_t i = 0; i < view.rgba.size(); i += 4) {
    product += uint32_t{view.rgba[i + channel]} * view.rgba[i + 1];
    square += uint32_t{view.rgba[i + 1]} * view.rgba[i + 1];
  }
  if (square == 0) return 1u << kUnitFactorBits;
  return static_cast<uint8_t>(std::min<uint64_t>(255, ((product << kUnitFactorBits) + square / 2) / square));
}

// Plane `index` of the view, before filtering.
Bytes extractedPlane(const ViewImage& view, uint32_t index, std::array<uint8_t, 2> factors) {
  Bytes plane(view.depth.size());
  const uint8_t* rgba = view.rgba.data();
  for (size_t i = 0; i < plane.size(); ++i, rgba += 4) {
    switch (index) {
      case kAlpha:
        plane[i] = rgba[3];
        break;
      case kGreen:
        plane[i] = rgba[1];
        break;
      case kRed:
        plane[i] = static_cast<uint8_t>(rgba[0] - fromGreen(rgba[1], factors[0]));
        break;
      case kBlue:
        plane[i] = static_cast<uint8_t>(rgba[2] - fromGreen(rgba[1], factors[1]));
        break;
      case kDepth:
        plane[i] = view.depth[i];
        break;
      default:
        plane[i] = view.normal[2 * i + (index - kNormalX)];
    }
  }
  return plane;
}

bool zeroOutside(std::span<const uint8_t> plane, std::span<const uint8_t> mask) {
  uint8_t outside = 0;
  for (size_t i = 0; i < plane.size(); ++i) outside |= static_cast<uint8_t>(plane[i] & ~mask[i]);
  return outside == 0;
}

// The value of all stored texels into `value`; true when there is one. Of none it is 0.
bool isConstant(std::span<const uint8_t> plane, std::span<const uint8_t> mask, uint8_t& value) {
  const auto first = std::find(mask.begin(), mask.end(), 255);
  value = first == mask.end() ? uint8_t{0} : plane[static_cast<size_t>(first - mask.begin())];
  uint8_t different = 0;
  for (size_t i = 0; i < plane.size(); ++i) different |= static_cast<uint8_t>((plane[i] ^ value) & mask[i]);
  return different == 0;
}

// Small residuals deflate well: the sum of their magnitudes ranks filters, as PNG encoders do.
uint64_t residualCost(std::span<const uint8_t> values) {
  uint64_t sum = 0;
  for (const uint8_t value : values) sum += static_cast<uint32_t>(std::abs(static_cast<int8_t>(value)));
  return sum;
}

// Appends the cheapest residuals and returns their filter; on a tie the first.
PlaneFilter appendFiltered(uint32_t index, std::span<const uint8_t> plane, std::span<const uint8_t> alpha,
                           std::span<const uint8_t> mask, PlaneSize size, ByteWriter& out) {
  Bytes best;
  PlaneFilter bestFilter = PlaneFilter::none;
  uint64_t bestCost = UINT64_MAX;
  for (uint32_t i = 0; i <= static_cast<uint32_t>(PlaneFilter::gradient); ++i) {
    const auto filter = static_cast<PlaneFilter>(i);
    Bytes candidate =
        index == kGreen ? colourResiduals(filter, plane, alpha, mask, size) : residuals(filter, plane, mask, size);
    const uint64_t cost = residualCost(candidate);
    if (cost >= bestCost) continue;
    bestCost = cost;
    bestFilter = filter;
    best = std::move(candidate);
  }
  out.append(std::as_bytes(std::span(best)));
  return bestFilter;
}

// Stored texels to their places, 0 elsewhere; false when there are fewer.
bool expand(ByteReader& in, std::span<const uint8_t> mask, std::span<uint8_t> plane) {
  size_t count = 0;
  for (const uint8_t m : mask) count += m & 1;
  const std::span<const std::byte> stored = in.take(count);
  if (stored.size() != count) return false;
  const std::byte* next = stored.data();
  const auto expandTexel = [&](size_t i) { plane[i] = mask[i] != 0 ? std::to_integer<uint8_t>(*next++) : uint8_t{0}; };
  // Eight at a time: most lie inside the mask or outside.
  constexpr size_t kChunk = 8;
  size_t i = 0;
  for (; i + kChunk <= plane.size(); i += kChunk) {
    uint64_t chunk = 0;
    std::memcpy(&chunk, mask.data() + i, kChunk);
    if (chunk == 0) {
      std::memset(plane.data() + i, 0, kChunk);
    } else if (chunk == ~uint64_t{0}) {
      std::memcpy(plane.data() + i, next, kChunk);
      next += kChunk;
    } else {
      for (size_t k = 0; k < kChunk; ++k) expandTexel(i + k);
    }
  }
  for (; i < plane.size(); ++i) expandTexel(i);
  return true;
}

bool readPlane(ByteReader& in, uint32_t index, PlaneFilter filter, std::span<const uint8_t> alpha,
               std::span<const uint8_t> mask, PlaneSize size, std::span<uint8_t> plane) {
  if (filter == PlaneFilter::constant) {
    const uint8_t value = in.u8();
    for (size_t i = 0; i < plane.size(); ++i) plane[i] = value & mask[i];
    return in.ok();
  }
  if (!expand(in, mask, plane)) return false;
  if (index == kGreen)
    undoColourFilter(filter, plane, alpha, size);
  else
    undoFilter(filter, plane, size);
  if (filter != PlaneFilter::none)
    for (size_t i = 0; i < plane.size(); ++i) plane[i] &= mask[i];
  return true;
}

void addGreen(std::span<uint8_t> plane, std::span<const uint8_t> green, uint32_t factor) {
  for (size_t i = 0; i < plane.size(); ++i) plane[i] = static_cast<uint8_t>(plane[i] + fromGreen(green[i], factor));
}

void interleave(const std::array<const uint8_t*, 4>& channels, std::span<uint8_t> rgba) {
  const uint8_t* const __restrict red = channels[0];
  const uint8_t* const __restrict green = channels[1];
  const uint8_t* const __restrict blue = channels[2];
  const uint8_t* const __restrict alpha = channels[3];
  uint8_t* const __restrict out = rgba.data();
  for (size_t i = 0; i < rgba.size() / 4; ++i) {
    out[4 * i] = red[i];
    out[4 * i + 1] = green[i];
    out[4 * i + 2] = blue[i];
    out[4 * i + 3] = alpha[i];
  }
}

}  // namespace

bool codingValid(ViewCoding coding, uint32_t planeCount) {
  if (coding >> kArrangementShift > static_cast<uint32_t>(Arrangement::sparse)) return false;
  const bool sparse = arrangementOf(coding) == Arrangement::sparse;
  for (uint32_t plane = 0; plane < kArrangementShift / kBitsPerFilter; ++plane) {
    const auto filter = static_cast<uint32_t>(filterOf(coding, plane));
    if (filter >= (plane < planeCount ? kPlaneFilterCount : 1)) return false;
    if (filter == static_cast<uint32_t>(PlaneFilter::constant) && !sparse) return false;
  }
  return true;
}

ArrangedView arrangedFromView(const ViewImage& view, uint32_t planeCount, Arrangement wanted) {
  const PlaneSize size{view.width, view.height};
  FARCELL_CHECK_EQ(view.rgba.size(), 4 * size.texels());
  FARCELL_CHECK_EQ(view.depth.size(), size.texels());
  FARCELL_CHECK_EQ(view.normal.size(), planeCount == kPlanesWithNormals ? 2 * size.texels() : 0);
  const std::array<uint8_t, 2> factors{factorOf(view, 0), factorOf(view, 2)};
  std::vector<Bytes> planes;
  for (uint32_t i = 0; i < planeCount; ++i) planes.push_back(extractedPlane(view, i, factors));
  const Masks masks(wanted, planes[kAlpha], size);
  ByteWriter out;
  for (const uint8_t factor : factors) out.u8(factor);
  ViewCoding coding = static_cast<uint32_t>(wanted) << kArrangementShift;
  for (uint32_t i = 0; i < planeCount; ++i) {
    const std::span<const uint8_t> mask = masks.of(i);
    if (!zeroOutside(planes[i], mask)) return arrangedFromView(view, planeCount, Arrangement::plain);
    PlaneFilter filter = PlaneFilter::constant;
    uint8_t value = 0;
    if (wanted == Arrangement::sparse && isConstant(planes[i], mask, value))
      out.u8(value);
    else
      filter = appendFiltered(i, planes[i], planes[kAlpha], mask, size, out);
    coding |= static_cast<uint32_t>(filter) << (kBitsPerFilter * i);
  }
  return {std::move(out.bytes), coding};
}

Result<> viewFromArranged(std::span<const std::byte> bytes, uint32_t planeCount, ViewCoding coding, ViewImage& view) {
  const PlaneSize size{view.width, view.height};
  const size_t texels = size.texels();
  ByteReader in(bytes);
  const std::array<uint8_t, 2> factors{in.u8(), in.u8()};
  Bytes planes(planeCount * texels);
  const auto plane = [&](uint32_t i) { return std::span(planes).subspan(i * texels, texels); };
  const auto read = [&](uint32_t i, const Masks& masks) {
    return readPlane(in, i, filterOf(coding, i), plane(kAlpha), masks.of(i), size, plane(i));
  };
  bool whole = read(kAlpha, Masks(Arrangement::plain, {}, size));
  const Masks masks(arrangementOf(coding), plane(kAlpha), size);
  for (uint32_t i = kGreen; i < planeCount; ++i) whole = whole && read(i, masks);
  if (!whole || in.remaining() != 0)
    return fail(ErrorKind::corrupt, "expected the planes of {} x {} texels, found {} bytes", size.width, size.height,
                bytes.size());

  addGreen(plane(kRed), plane(kGreen), factors[0]);
  addGreen(plane(kBlue), plane(kGreen), factors[1]);
  view.rgba.resize(4 * texels);
  interleave({plane(kRed).data(), plane(kGreen).data(), plane(kBlue).data(), plane(kAlpha).data()}, view.rgba);
  view.depth.assign(plane(kDepth).begin(), plane(kDepth).end());
  view.normal.resize((planeCount - kPlanesWithoutNormals) * texels);
  const uint8_t* normal = planes.data() + kNormalX * texels;
  for (size_t i = 0; 2 * i < view.normal.size(); ++i) {
    view.normal[2 * i] = normal[i];
    view.normal[2 * i + 1] = normal[texels + i];
  }
  return {};
}

}  // namespace farcell
