// How a triangle lies in scratch: its corners, and only those channels that the model has.
#pragma once

#include <array>
#include <cstddef>
#include <cstring>

#include "preprocess/partition/grid_triangles.h"

namespace farcell {

using Corners = std::array<GridPoint, 3>;
inline constexpr size_t kCornersBytes = sizeof(Corners);  // 36

// A record: 3 corners, then 3 colours, 3 normals and a TriangleTexture where the format has them. 36 to 88 bytes.
struct RecordFormat {
  bool colours = false;
  bool normals = false;
  bool textures = false;

  size_t bytes() const {
    return kCornersBytes + (colours ? sizeof(GridTriangle::colours) : 0) +
           (normals ? sizeof(GridTriangle::normals) : 0) + (textures ? sizeof(TriangleTexture) : 0);
  }
  void put(const GridTriangle& triangle, const TriangleTexture& texture, std::byte* record) const;
  // A channel that is left out: kDefaultAlbedo, no normals, no texture.
  GridTriangle triangle(const std::byte* record) const;
  TriangleTexture texture(const std::byte* record) const;
  bool operator==(const RecordFormat&) const = default;
};

inline Corners cornersOf(const std::byte* record) {
  Corners corners;
  std::memcpy(corners.data(), record, kCornersBytes);
  return corners;
}

}  // namespace farcell
