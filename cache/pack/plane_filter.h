// What is subtracted (modulo 256) from each texel of a plane of 8-bit values so that the rest deflates well.
//
// Texels outside the plane count as 0. A plane may be sparse: its mask is 0 where nothing is stored and 255 elsewhere.
// There a texel counts as its own prediction, so that what is next to it is predicted from the nearest stored texels.
// Exact: nothing is lost.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace farcell {

// constant: all stored texels are one value, which is stored once.
enum class PlaneFilter : uint8_t { none = 0, up = 1, left = 2, average = 3, gradient = 4, constant = 5 };
inline constexpr uint32_t kPlaneFilterCount = 6;

struct PlaneSize {
  size_t width;
  size_t height;
  size_t texels() const { return width * height; }
};

// The filter from none to gradient that leaves the smallest residuals where a texel is stored and its neighbours are.
// `weight` is 255 for texels to count, else 0.
PlaneFilter likelyFilter(std::span<const uint8_t> plane, std::span<const uint8_t> weight, PlaneSize size);

// The residuals of the stored texels, in order. `filter` is none to gradient.
std::vector<uint8_t> residuals(PlaneFilter filter, std::span<const uint8_t> plane, std::span<const uint8_t> mask,
                               PlaneSize size);
// Of a colour premultiplied by `alpha`: predicted from the colours of the neighbours before they were multiplied.
std::vector<uint8_t> colourResiduals(PlaneFilter filter, std::span<const uint8_t> colour,
                                     std::span<const uint8_t> alpha, std::span<const uint8_t> mask, PlaneSize size);

// What the texels of a plane may become: any of `low` to `low` + `room`, modulo 256.
struct PlaneBounds {
  std::span<const uint8_t> low;
  std::span<const uint8_t> room;
};

// Moves the stored texels inside their bounds so that few different residuals are left: multiples of `step` where one
// is in reach, and each texel is predicted from those before it as they were moved. `room` is below `step`.
void moveTexels(PlaneFilter filter, PlaneBounds bounds, int step, std::span<const uint8_t> mask, PlaneSize size,
                std::span<uint8_t> plane);
void moveColours(PlaneFilter filter, PlaneBounds bounds, int step, std::span<const uint8_t> alpha,
                 std::span<const uint8_t> mask, PlaneSize size, std::span<uint8_t> colour);

// Residuals, 0 where nothing is stored, to texels; texels that are not stored keep their prediction, of colours 0.
void undoFilter(PlaneFilter filter, std::span<uint8_t> plane, PlaneSize size);
void undoColourFilter(PlaneFilter filter, std::span<uint8_t> colour, std::span<const uint8_t> alpha, PlaneSize size);

}  // namespace farcell
