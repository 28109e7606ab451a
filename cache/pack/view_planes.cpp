#include "cache/pack/view_planes.h"

#include <algorithm>
#include <array>
#include <cstdlib>

#include "cache/base/check.h"

namespace farcell {
namespace {

constexpr uint32_t kBitsPerFilter = 4;
constexpr uint32_t kFilterMask = (1u << kBitsPerFilter) - 1;
constexpr uint32_t kArrangementShift = 28;

struct Size {
  size_t width;
  size_t height;
  size_t texels() const { return width * height; }
};

uint8_t average(uint8_t a, uint8_t b) { return static_cast<uint8_t>((a + b) / 2); }

// out[i] = plane[i] - prediction.
void applyFilter(PlaneFilter filter, std::span<const uint8_t> plane, Size size, uint8_t* out) {
  for (size_t y = 0; y < size.height; ++y) {
    const uint8_t* row = plane.data() + y * size.width;
    const uint8_t* below = y > 0 ? row - size.width : nullptr;
    for (size_t x = 0; x < size.width; ++x) {
      const uint8_t left = x > 0 ? row[x - 1] : 0;
      const uint8_t up = below != nullptr ? below[x] : 0;
      uint8_t prediction = 0;
      if (filter == PlaneFilter::up) prediction = up;
      if (filter == PlaneFilter::left) prediction = left;
      if (filter == PlaneFilter::average) prediction = average(left, up);
      *out++ = static_cast<uint8_t>(row[x] - prediction);
    }
  }
}

void undoUp(uint8_t* plane, Size size) {
  for (size_t i = size.width; i < size.texels(); ++i) plane[i] = static_cast<uint8_t>(plane[i] + plane[i - size.width]);
}

void undoLeft(uint8_t* plane, Size size) {
  for (size_t y = 0; y < size.height; ++y, plane += size.width)
    for (size_t x = 1; x < size.width; ++x) plane[x] = static_cast<uint8_t>(plane[x] + plane[x - 1]);
}

void undoAverage(uint8_t* plane, Size size) {
  for (size_t y = 0; y < size.height; ++y, plane += size.width) {
    uint8_t left = 0;
    for (size_t x = 0; x < size.width; ++x) {
      const uint8_t up = y > 0 ? plane[static_cast<ptrdiff_t>(x) - static_cast<ptrdiff_t>(size.width)] : uint8_t{0};
      left = plane[x] = static_cast<uint8_t>(plane[x] + average(left, up));
    }
  }
}

void undoFilter(PlaneFilter filter, uint8_t* plane, Size size) {
  switch (filter) {
    case PlaneFilter::none:
      return;
    case PlaneFilter::up:
      return undoUp(plane, size);
    case PlaneFilter::left:
      return undoLeft(plane, size);
    case PlaneFilter::average:
      return undoAverage(plane, size);
  }
}

// Small residuals deflate well: the sum of their magnitudes ranks filters, as PNG encoders do.
uint64_t residualCost(std::span<const uint8_t> residuals) {
  uint64_t sum = 0;
  for (const uint8_t value : residuals) sum += static_cast<uint64_t>(std::abs(static_cast<int8_t>(value)));
  return sum;
}

// Writes the cheapest residuals to `out` and returns their filter; on a tie the lowest.
PlaneFilter filterPlane(std::span<const uint8_t> plane, Size size, uint8_t* out) {
  std::vector<uint8_t> candidate(plane.size());
  PlaneFilter best = PlaneFilter::none;
  uint64_t bestCost = UINT64_MAX;
  for (uint32_t i = 0; i < kPlaneFilterCount; ++i) {
    applyFilter(static_cast<PlaneFilter>(i), plane, size, candidate.data());
    const uint64_t cost = residualCost(candidate);
    if (cost >= bestCost) continue;
    bestCost = cost;
    best = static_cast<PlaneFilter>(i);
    std::copy(candidate.begin(), candidate.end(), out);
  }
  return best;
}

// The value of colour plane `plane` at a texel, and the texel back from its four values.
uint8_t colourValue(const uint8_t* rgba, uint32_t plane) {
  switch (plane) {
    case 0:
      return rgba[1];
    case 1:
      return static_cast<uint8_t>(rgba[0] - rgba[1]);
    case 2:
      return static_cast<uint8_t>(rgba[2] - rgba[1]);
    default:
      return rgba[3];
  }
}

void setColour(uint8_t* rgba, uint8_t green, uint8_t red, uint8_t blue, uint8_t alpha) {
  rgba[0] = static_cast<uint8_t>(red + green);
  rgba[1] = green;
  rgba[2] = static_cast<uint8_t>(blue + green);
  rgba[3] = alpha;
}

// Plane `index` of the view, before filtering.
void extractPlane(const ViewImage& view, uint32_t index, std::span<uint8_t> plane) {
  for (size_t i = 0; i < plane.size(); ++i) {
    if (index < kColourPlanes)
      plane[i] = colourValue(view.rgba.data() + 4 * i, index);
    else if (index < kPlanesWithoutNormals)
      plane[i] = view.depth[i];
    else
      plane[i] = view.normal[2 * i + (index - kPlanesWithoutNormals)];
  }
}

Arrangement arrangementOf(ViewCoding coding) { return static_cast<Arrangement>(coding >> kArrangementShift); }

uint32_t firstFilteredPlane(Arrangement arrangement) { return arrangement == Arrangement::texels ? kColourPlanes : 0; }

}  // namespace

bool codingValid(ViewCoding coding, uint32_t planeCount) {
  if (coding >> kArrangementShift > static_cast<uint32_t>(Arrangement::planes)) return false;
  const uint32_t first = firstFilteredPlane(arrangementOf(coding));
  for (uint32_t plane = 0; plane < kArrangementShift / kBitsPerFilter; ++plane) {
    const uint32_t filter = coding >> (kBitsPerFilter * plane) & kFilterMask;
    if (filter >= (plane >= first && plane < planeCount ? kPlaneFilterCount : 1)) return false;
  }
  return true;
}

ArrangedView arrangedFromView(const ViewImage& view, uint32_t planeCount, Arrangement arrangement) {
  const Size size{view.width, view.height};
  FARCELL_CHECK_EQ(view.rgba.size(), 4 * size.texels());
  FARCELL_CHECK_EQ(view.depth.size(), size.texels());
  FARCELL_CHECK_EQ(view.normal.size(), planeCount == kPlanesWithNormals ? 2 * size.texels() : 0);
  ArrangedView result;
  result.bytes.resize(planeCount * size.texels());
  result.coding = static_cast<uint32_t>(arrangement) << kArrangementShift;
  auto* out = reinterpret_cast<uint8_t*>(result.bytes.data());
  if (arrangement == Arrangement::texels)
    for (size_t i = 0; i < kColourPlanes * size.texels(); ++i)
      out[i] = colourValue(view.rgba.data() + i / 4 * 4, static_cast<uint32_t>(i % 4));
  std::vector<uint8_t> plane(size.texels());
  for (uint32_t i = firstFilteredPlane(arrangement); i < planeCount; ++i) {
    extractPlane(view, i, plane);
    const PlaneFilter filter = filterPlane(plane, size, out + i * size.texels());
    result.coding |= static_cast<uint32_t>(filter) << (kBitsPerFilter * i);
  }
  return result;
}

void viewFromArranged(std::span<const std::byte> bytes, uint32_t planeCount, ViewCoding coding, ViewImage& view) {
  const Size size{view.width, view.height};
  const size_t texels = size.texels();
  FARCELL_CHECK_EQ(bytes.size(), planeCount * texels);
  const auto* begin = reinterpret_cast<const uint8_t*>(bytes.data());
  std::vector<uint8_t> plain(begin, begin + bytes.size());
  const Arrangement arrangement = arrangementOf(coding);
  for (uint32_t i = firstFilteredPlane(arrangement); i < planeCount; ++i)
    undoFilter(static_cast<PlaneFilter>(coding >> (kBitsPerFilter * i) & kFilterMask), plain.data() + i * texels, size);

  view.rgba.resize(4 * texels);
  // Steps from one channel of a texel to the next, and from one texel to the next.
  const size_t channelStep = arrangement == Arrangement::texels ? 1 : texels;
  const size_t texelStep = arrangement == Arrangement::texels ? 4 : 1;
  for (size_t i = 0; i < texels; ++i) {
    const uint8_t* in = plain.data() + i * texelStep;
    setColour(view.rgba.data() + 4 * i, in[0], in[channelStep], in[2 * channelStep], in[3 * channelStep]);
  }
  const auto depth = plain.begin() + static_cast<ptrdiff_t>(kColourPlanes * texels);
  view.depth.assign(depth, depth + static_cast<ptrdiff_t>(texels));
  view.normal.assign((planeCount - kPlanesWithoutNormals) * texels, 0);
  const uint8_t* normal = plain.data() + kPlanesWithoutNormals * texels;
  for (size_t i = 0; i < view.normal.size(); ++i) view.normal[i] = normal[i % 2 * texels + i / 2];
}

}  // namespace farcell
