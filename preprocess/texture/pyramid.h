// An image and its halved, quartered, ... versions, cut into tiles, made row by row as the image is decoded.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "cache/base/result.h"

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

class PyramidBuilder {
 public:
  // Takes consecutive tiles, the first of them by its index in the pyramid.
  using Sink = std::function<Result<>(uint64_t firstTile, std::span<const uint32_t> pixels)>;

  // Both must outlive the builder. The memory it takes: some 64 rows of the image.
  PyramidBuilder(std::span<const PyramidLevel> levels, const Sink& sink);
  // The next row of the image, 0x00BBGGRR, levels[0].width long. After the last one the pyramid is complete.
  Result<> addRow(std::span<const uint32_t> row) { return addRow(0, row); }

 private:
  using Sums = std::vector<uint64_t>;  // three channels a pixel
  struct LevelRows {
    std::vector<uint32_t> tiles;  // the row of tiles that is being filled
    int rows = 0;                 // of the level, taken so far
    Sums sums;                    // of the next level's row that is being filled
  };

  Result<> addRow(size_t level, std::span<const uint32_t> row);
  Result<> halve(size_t level, std::span<const uint32_t> row);

  std::span<const PyramidLevel> levels_;
  const Sink& sink_;
  std::vector<LevelRows> rows_;
};

}  // namespace farcell
