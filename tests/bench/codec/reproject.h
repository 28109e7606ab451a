// Whether a neighbouring view, carried over through depth, predicts a view better than its own texels do.
#pragma once

#include <array>
#include <cstdint>

#include "cache/pack/pages.h"
#include "cache/schema/viewpoints.h"

namespace farcell {

// Predictions of green and of depth; the others stay as built.
enum class Carried : uint8_t {
  none,       // the filters as they are
  alone,      // the neighbour's value where there is one
  corrected,  // and what the filter says of the difference from it
  judged,     // that or the filter, whichever was nearer at the texels before
  averaged,   // the mean of both
};
inline constexpr size_t kCarriedWays = 5;

struct ReprojectTotals {
  uint64_t views = 0;
  uint64_t texels = 0;                              // covered
  uint64_t carriedTexels = 0;                       // of these, those that the neighbour shows
  uint64_t builtBytes = 0;                          // as built
  uint64_t alphaBytes = 0;                          // of which the coverage alone takes
  std::array<uint64_t, kCarriedWays> greenBytes{};  // alone, the best filter by deflate
  std::array<uint64_t, kCarriedWays> depthBytes{};
  uint64_t bestBytes = 0;         // whole streams of the best ways
  uint64_t bestWithoutBytes = 0;  // whole streams of the best filters, nothing carried
};

// Skips views without texels to compare.
void addReprojected(const ViewImage& view, const ViewImage& neighbour, const Viewpoints& viewpoints, int imageSize,
                    ReprojectTotals& totals);

}  // namespace farcell
