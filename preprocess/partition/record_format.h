// How a triangle lies in scratch: its corners, and only those channels that the model has.
#pragma once

#include <array>
#include <cstddef>
#include <cstring>

#include "preprocess/partition/grid_triangles.h"

namespace farcell {

using Corners = std::array<GridPoint, 3>;

// A record: nine words, the coordinates of the corners one after the other in their low 24 bits and a channel of that
// corner's colour - red, green, blue with x, y, z - in the others; then three normals and a TriangleTexture where the
// format has them. 36 to 76 bytes. Coordinates are below 2^24.
inline constexpr size_t kCornersBytes = 9 * sizeof(uint32_t);
inline constexpr uint32_t kCoordinateMask = 0xffffff;
static_assert(kMaxGridBits <= 24);

struct RecordFormat {
  bool colours = false;
  bool normals = false;
  bool textures = false;

  size_t bytes() const {
    return kCornersBytes + (normals ? sizeof(GridTriangle::normals) : 0) + (textures ? sizeof(TriangleTexture) : 0);
  }
  void put(const GridTriangle& triangle, const TriangleTexture& texture, std::byte* record) const;
  // A channel that is left out: kDefaultAlbedo, no normals, no texture.
  GridTriangle triangle(const std::byte* record) const;
  TriangleTexture texture(const std::byte* record) const;
  bool operator==(const RecordFormat&) const = default;
};

inline Corners cornersOf(const std::byte* record) {
  std::array<uint32_t, 9> words;
  std::memcpy(words.data(), record, kCornersBytes);
  Corners corners;
  for (int i = 0; i < 9; ++i) corners[i / 3][i % 3] = static_cast<int32_t>(words[i] & kCoordinateMask);
  return corners;
}

}  // namespace farcell
