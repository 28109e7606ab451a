// What a cell's views are worth: the cost model by which a build decides what to keep. A fixed table, so that a pack
// does not depend on the machine that builds it.
//
// Assumptions:
// - Pictures of 720 lines and a vertical field of view of 40 degrees, 4 samples a pixel.
// - A visitor's distance from a cell is as likely within one octave as within any other, from where the finest views
//   are first drawn to four times as far as the root's (the level rule of runtime/selection, kWorthTexelPixels).
//   Where images are of one size, a cell's views are first drawn one octave before its parent's. Directions are
//   equally likely.
// - A cell is drawn whole or not at all, everything in it at one distance; what hides it is not known.
// - Cost is time on the measured machine (no GPU: MEASURED.md, tests/bench/figures/results.md) plus error, at the price
//   that going from 1 to 4 samples pays for error: microseconds a frame. Error is that of evaluate, of which a pixel of
//   the full geometry at 1 sample has 1, as measured (CellRecord::errors).
// The worth of a cell's views is the cost of what would be drawn instead less their own, summed over octaves.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "cache/pack/directory.h"

namespace farcell {

struct CostTable {
  double triangleUs = 0.2;      // full linz-west at 4 samples: 301 ms for 1.27 M
  double meshUs = 30;           // a leaf's triangles drawn at all
  double impostorUs = 10;       // an impostor drawn at all
  double pixelUs = 0.08;        // of an impostor of kind A, four rays
  double texelUs = 0.002;       // of the two views: read, inflated and uploaded once in a while
  double triangleError = 0.40;  // a pixel, 4 samples; where the cell's own is not known
  double impostorError = 0.27;  // a pixel, kind A, texels of half a pixel or less; likewise
  double errorUs = 0.3;         // price of a pixel of error 1: what 4 samples take more than 1, for .6 less
};
inline constexpr CostTable kCosts{};

// As runtime/selection draws views: from where a texel is this part of a pixel.
inline constexpr double kWorthTexelPixels = 0.5;

// The costs of drawing every subtree, at each of some distances, while cells come to have views or lose them.
class Worth {
 public:
  // meanTexels: per cell, of its views' cropped rectangles; 0 where it has none to choose from. No cell has views yet.
  // Both must outlive this.
  Worth(std::span<const CellRecord> cells, std::span<const float> meanTexels);

  // What the views of `cell` are worth now: from where they are first drawn to where the views of the nearest ancestor
  // for which `keeps` is true take over (any callable of a cell's index).
  template <class Keeps>
  double of(uint32_t cell, const Keeps& keeps) const {
    uint32_t above = cells_[cell].parent;
    while (above != kNone && !keeps(above)) above = cells_[above].parent;
    return between(cell, above == kNone ? samples_ : first(above));
  }
  // Of drawing the whole model as it is now, microseconds a frame summed over octaves.
  double total() const;
  // From here on the cell has views.
  void keep(uint32_t cell);

 private:
  int first(uint32_t cell) const;  // sample at which its views are first drawn
  double between(uint32_t cell, int end) const;
  double impostor(uint32_t cell, int sample) const;
  double without(uint32_t cell, int sample) const;
  double texelPixels(uint32_t cell, int sample) const;
  double pixels(uint32_t cell, int sample) const;
  // As the cell's table has it; where that does not know, `unknown`.
  double error(uint32_t cell, ErrorWay way, int sample, double unknown) const;
  double& cost(uint32_t cell, int sample) { return costs_[static_cast<size_t>(cell) * samples_ + sample]; }

  std::span<const CellRecord> cells_;
  std::span<const float> meanTexels_;
  int finest_ = 0;  // octaves, see worth.cpp
  int samples_ = 0;
  std::vector<bool> kept_;
  std::vector<double> costs_;  // by cell, then sample
};

}  // namespace farcell
