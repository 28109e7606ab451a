// One view as planes that deflate well: each channel by itself, red and blue as differences from green, every plane
// filtered by its neighbours. The transform is exact and loses nothing.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "cache/pack/pages.h"

namespace farcell {

// Planes in the order they are stored: G, R - G, B - G, A, depth, and with normals x, y.
inline constexpr uint32_t kPlanesWithoutNormals = 5;
inline constexpr uint32_t kPlanesWithNormals = 7;

// What is subtracted (modulo 256) from each texel; texels outside the rectangle count as 0.
enum class PlaneFilter : uint8_t { none = 0, up = 1, left = 2, average = 3 };
inline constexpr uint32_t kPlaneFilterCount = 4;
inline constexpr int kBitsPerFilter = 4;

struct FilteredView {
  std::vector<std::byte> planes;  // planeCount * width * height
  uint32_t filters = 0;           // kBitsPerFilter bits a plane, the first plane lowest
};

// Chooses a filter for each plane. REQUIRES: sizes of rgba, depth and normal agree with width * height.
FilteredView filteredFromView(const ViewImage& view, uint32_t planeCount);

// Fills view.rgba, depth and normal. REQUIRES: planes.size() == planeCount * width * height, filters are valid.
void viewFromFiltered(std::span<const std::byte> planes, uint32_t planeCount, uint32_t filters, ViewImage& view);

}  // namespace farcell
