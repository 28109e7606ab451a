#include "cache/pack/view_planes.h"

#include <algorithm>
#include <array>
#include <cstdlib>

#include "cache/base/check.h"

namespace farcell {
namespace {

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
    case PlaneFilter::none: return;
    case PlaneFilter::up: return undoUp(plane, size);
    case PlaneFilter::left: return undoLeft(plane, size);
    case PlaneFilter::average: return undoAverage(plane, size);
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

// Plane `index` of the view, before filtering.
void extractPlane(const ViewImage& view, uint32_t index, std::span<uint8_t> plane) {
  const uint8_t* rgba = view.rgba.data();
  for (size_t i = 0; i < plane.size(); ++i, rgba += 4) {
    switch (index) {
      case 0: plane[i] = rgba[1]; break;
      case 1: plane[i] = static_cast<uint8_t>(rgba[0] - rgba[1]); break;
      case 2: plane[i] = static_cast<uint8_t>(rgba[2] - rgba[1]); break;
      case 3: plane[i] = rgba[3]; break;
      case 4: plane[i] = view.depth[i]; break;
      default: plane[i] = view.normal[2 * i + (index - kPlanesWithoutNormals)]; break;
    }
  }
}

}  // namespace

FilteredView filteredFromView(const ViewImage& view, uint32_t planeCount) {
  const Size size{view.width, view.height};
  FARCELL_CHECK_EQ(view.rgba.size(), 4 * size.texels());
  FARCELL_CHECK_EQ(view.depth.size(), size.texels());
  FARCELL_CHECK_EQ(view.normal.size(), planeCount == kPlanesWithNormals ? 2 * size.texels() : 0);
  FilteredView result;
  result.planes.resize(planeCount * size.texels());
  std::vector<uint8_t> plane(size.texels());
  for (uint32_t i = 0; i < planeCount; ++i) {
    extractPlane(view, i, plane);
    auto* out = reinterpret_cast<uint8_t*>(result.planes.data() + i * size.texels());
    result.filters |= static_cast<uint32_t>(filterPlane(plane, size, out)) << (kBitsPerFilter * i);
  }
  return result;
}

void viewFromFiltered(std::span<const std::byte> planes, uint32_t planeCount, uint32_t filters, ViewImage& view) {
  const Size size{view.width, view.height};
  FARCELL_CHECK_EQ(planes.size(), planeCount * size.texels());
  std::vector<uint8_t> plain(planes.size());
  std::transform(planes.begin(), planes.end(), plain.begin(), [](std::byte b) { return std::to_integer<uint8_t>(b); });
  for (uint32_t i = 0; i < planeCount; ++i) {
    const auto filter = static_cast<PlaneFilter>(filters >> (kBitsPerFilter * i) & ((1u << kBitsPerFilter) - 1));
    undoFilter(filter, plain.data() + i * size.texels(), size);
  }
  const auto plane = [&](size_t index) { return plain.data() + index * size.texels(); };
  view.rgba.resize(4 * size.texels());
  for (size_t i = 0; i < size.texels(); ++i) {
    const uint8_t green = plane(0)[i];
    view.rgba[4 * i + 0] = static_cast<uint8_t>(plane(1)[i] + green);
    view.rgba[4 * i + 1] = green;
    view.rgba[4 * i + 2] = static_cast<uint8_t>(plane(2)[i] + green);
    view.rgba[4 * i + 3] = plane(3)[i];
  }
  view.depth.assign(plane(4), plane(4) + size.texels());
  view.normal.clear();
  if (planeCount == kPlanesWithoutNormals) return;
  view.normal.resize(2 * size.texels());
  for (size_t i = 0; i < 2 * size.texels(); ++i) view.normal[i] = plane(5 + i % 2)[i / 2];
}

}  // namespace farcell
