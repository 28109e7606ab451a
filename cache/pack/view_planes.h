// One view as bytes that deflate well. The transforms are exact: nothing is lost.
//
// Colour is taken as G, R - G, B - G, A (modulo 256), which is small where a surface is grey or alike. A prefiltered
// view of flat faces repeats whole texels, and a view of a textured or curved surface varies smoothly: the first
// deflates best as texels, the second as filtered planes, so there are two arrangements and the encoder keeps the
// smaller.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "cache/pack/pages.h"

namespace farcell {

// Planes in the order they are stored: G, R - G, B - G, A, depth, and with normals x, y.
inline constexpr uint32_t kColourPlanes = 4;
inline constexpr uint32_t kPlanesWithoutNormals = 5;
inline constexpr uint32_t kPlanesWithNormals = 7;

// What is subtracted (modulo 256) from each texel of a plane; texels outside the rectangle count as 0.
enum class PlaneFilter : uint8_t { none = 0, up = 1, left = 2, average = 3 };
inline constexpr uint32_t kPlaneFilterCount = 4;

// texels: the four colour bytes of each texel together, unfiltered, then the other planes, filtered.
// planes: all planes one after the other, filtered.
enum class Arrangement : uint8_t { texels = 0, planes = 1 };

// How a view's bytes were made, as stored: 4 bits a plane name its filter, the first plane lowest, and the top 4 bits
// the arrangement.
using ViewCoding = uint32_t;
bool codingValid(ViewCoding coding, uint32_t planeCount);

struct ArrangedView {
  std::vector<std::byte> bytes;  // planeCount * width * height
  ViewCoding coding = 0;
};

// Chooses a filter for each plane. REQUIRES: sizes of rgba, depth and normal agree with width * height.
ArrangedView arrangedFromView(const ViewImage& view, uint32_t planeCount, Arrangement arrangement);

// Fills view.rgba, depth and normal. REQUIRES: bytes.size() == planeCount * width * height, codingValid().
void viewFromArranged(std::span<const std::byte> bytes, uint32_t planeCount, ViewCoding coding, ViewImage& view);

}  // namespace farcell
