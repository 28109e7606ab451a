// An image and its halved, quartered, ... versions, cut into tiles, made row by row as the image is decoded.
//
// Pixels are 0xAABBGGRR. Means of colours are weighted by alpha: what is transparent colours nothing. The smaller
// versions of a mask hold how much of it is left: what of a mask's mean alpha exceeds the cutoff says nothing about its
// area.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "cache/base/result.h"
#include "preprocess/mesh/texture_source.h"

namespace farcell {

inline constexpr int kTileEdge = 32;  // pixels; a tile is a page of memory
inline constexpr size_t kTilePixels = size_t{kTileEdge} * kTileEdge;

// Rows of tiles from the top one down. Pixels beyond the level's edge are zero.
struct PyramidLevel {
  int width = 0, height = 0;
  uint32_t tilesAcross = 0, tilesDown = 0;
  uint64_t firstTile = 0;  // from the pyramid's first
};

// From the image itself to a single pixel; each edge is half the one before, rounded down, at least 1.
std::vector<PyramidLevel> pyramidLevels(int width, int height);
uint64_t tileCount(std::span<const PyramidLevel> levels);

// Whether a mask has surface where alpha, in [0, 1], is this.
inline bool passes(const SurfaceKind& mask, float alpha) { return alpha >= mask.cutoff; }

class PyramidBuilder {
 public:
  // Takes consecutive tiles, the first of them by its index in the pyramid.
  using Sink = std::function<Result<>(uint64_t firstTile, std::span<const uint32_t> pixels)>;

  // Levels and sink must outlive the builder. The memory it takes: some 64 rows of the image.
  PyramidBuilder(std::span<const PyramidLevel> levels, const SurfaceKind& surface, const Sink& sink);
  // The next row of the image, levels[0].width long. After the last one the pyramid is complete.
  Result<> addRow(std::span<const uint32_t> row) { return addRow(0, row); }

 private:
  using Sums = std::vector<uint64_t>;  // three channels times alpha, and alpha, a pixel
  struct LevelRows {
    std::vector<uint32_t> tiles;  // the row of tiles that is being filled
    int rows = 0;                 // of the level, taken so far
    Sums sums;                    // of the next level's row that is being filled
  };

  Result<> addRow(size_t level, std::span<const uint32_t> row);
  Result<> halve(size_t level, std::span<const uint32_t> row);

  std::span<const PyramidLevel> levels_;
  const SurfaceKind surface_;
  const Sink& sink_;
  std::vector<LevelRows> rows_;
};

}  // namespace farcell
