// One view as bytes that deflate well. The transforms are exact: nothing is lost but what is asked for.
//
// Colour follows coverage: it is coded where coverage is not 0, and predicted through it. Where a surface has one
// colour and is lit differently, red and blue follow green by a factor; else they follow it by about 1.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "cache/pack/pages.h"
#include "cache/pack/plane_filter.h"

namespace farcell {

// Planes in the order they are stored: A, G, R, B, depth, and with normals x, y, length.
inline constexpr uint32_t kPlanesWithoutNormals = 5;
inline constexpr uint32_t kPlanesWithNormals = 8;

// plain: every texel of every plane. sparse: without the texels that coverage says are 0, and planes may be constant.
enum class Arrangement : uint8_t { plain = 0, sparse = 1 };

// How a view's bytes were made, as stored: 3 bits a plane name its filter, the first plane lowest, and the top 4 bits
// the arrangement.
using ViewCoding = uint32_t;
bool codingValid(ViewCoding coding, uint32_t planeCount);

// The most bytes that a view of so many texels takes, arranged.
constexpr size_t arrangedBytesLimit(uint32_t planeCount, size_t texels) { return 2 + planeCount * texels; }

struct ArrangedView {
  std::vector<std::byte> bytes;
  ViewCoding coding = 0;
};

// The factors by which red and blue follow green, as stored.
using ColourFactors = std::array<uint8_t, 2>;
ColourFactors factorsOfArranged(std::span<const std::byte> bytes);

struct ArrangeOptions {
  int maxError = 0;                      // see below
  bool triesFilters = false;             // chooses each filter by what deflate makes of it, not by an estimate
  std::optional<ColourFactors> factors;  // none: those of least squares
};

// Chooses a filter for each plane. A view with values where a sparse one has none is arranged plainly. With a maxError
// above 0 no channel is farther than that from the view's: coverage of 0 and 255 and unknown depth stay, others do not
// become these, and a colour stays within its coverage.
// REQUIRES: sizes of rgba, depth and normal agree with width * height; maxError is 0 to kMaxViewError.
ArrangedView arrangedFromView(const ViewImage& view, uint32_t planeCount, Arrangement wanted,
                              const ArrangeOptions& options);

// Fills view.rgba, depth and normal. corrupt when there are too few or too many bytes. REQUIRES: codingValid().
Result<> viewFromArranged(std::span<const std::byte> bytes, uint32_t planeCount, ViewCoding coding, ViewImage& view);

}  // namespace farcell
