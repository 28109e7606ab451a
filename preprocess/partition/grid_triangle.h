// Triangles on the model's grid, and how a plane cuts them.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

#include "cache/schema/grid.h"
#include "preprocess/partition/grid_triangles.h"

namespace farcell {

GridBox boxOf(const GridTriangle& triangle);
// No area on the grid: the corners lie on one line.
bool isDegenerate(const GridTriangle& triangle);

// A triangle or what planes left of it: convex, up to the rounding of its corners to the grid. Kept whole while a cell
// is cut again and again: a fan of triangles would be cut into ever more of them.
struct GridCorner {
  GridPoint position;
  uint32_t colour;
  uint32_t normal;
  glm::vec2 coordinates;  // on the polygon's texture
};
struct GridPolygon {
  static constexpr int kMaxCorners = 12;
  int count = 0;
  uint32_t texture = kNoTexture;
  std::array<GridCorner, kMaxCorners> corners;

  GridPolygon() = default;
  // Of the corners those in use: most polygons have three or four.
  GridPolygon(const GridPolygon& other) { *this = other; }
  GridPolygon& operator=(const GridPolygon& other) {
    count = other.count;
    texture = other.texture;
    std::copy_n(other.corners.begin(), static_cast<size_t>(count), corners.begin());
    return *this;
  }
};

GridPolygon polygonOf(const GridTriangle& triangle, const TriangleTexture& texture);
GridBox boxOf(const GridPolygon& polygon);
// Appends the polygon's triangles, without the degenerate ones.
void appendTriangles(const GridPolygon& polygon, GridTriangles& out);

// The parts of a polygon on the two sides of coordinate `plane` of `axis`; a part without area has count 0.
// A polygon inside the plane belongs to `high` alone, so that no two cells draw the same surface. New corners are
// rounded to the grid by a rule that depends on the edge only: whatever else shares the edge gets the same corner.
struct CutPolygon {
  GridPolygon low, high;
};
// REQUIRES: count < kMaxCorners (one plane adds at most one corner to a convex polygon).
CutPolygon cutAt(const GridPolygon& polygon, int axis, int32_t plane);

// Octahedral snorm16 pair of a vector of any length but zero (0 for zero), and back.
uint32_t packNormal(glm::vec3 normal);
glm::vec3 unpackNormal(uint32_t packed);

}  // namespace farcell
