// A base mesh cut finer: which vertices and faces there are, each by its number alone, so that any part of a statue can
// be made without the rest.
//
// 1. Every edge of the base is cut into a count of its own, so that all triangles round it agree and no crack opens.
// 2. Inside a triangle lies a regular grid of n rows: its points are (i, j, k) / n with i, j, k >= 1 as weights of the
//    corners. Three strips join it to the three sides, whatever their counts.
// 3. Vertices are numbered: corners of the base, then the inner points of its edges (edge by edge, from the lower
// corner
//    up), then the grids (triangle by triangle, row by row from corner 2 to the side 0-1).
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "datasets/statue/base_mesh.h"

namespace farcell {

// A point of the base: the sum of corners times weights. Unused weights are exactly 0.
struct SurfacePoint {
  std::array<uint32_t, 3> corners{};
  std::array<double, 3> weights{};
};

class Subdivision {
 public:
  // As near to `wished` faces as edge counts allow, and at least as many as the base has: within 5 % of `wished` from
  // some hundreds on. Cut edges have nearly one length; rounding up or down goes by `seed`. `mesh` must outlive it.
  // unsupported when 32 bits cannot number the vertices.
  static Result<Subdivision> create(const BaseMesh& mesh, uint64_t wished, uint64_t seed);

  uint64_t vertexCount() const { return interiorFirst_.back(); }
  uint64_t faceCount() const { return faceFirst_.back(); }
  double edgeLength() const { return edgeLength_; }  // wished for, in the unit of the base

  // Numbers first, first + 1, ... REQUIRES: all of them exist.
  void points(uint64_t first, std::span<SurfacePoint> out) const;
  void faces(uint64_t first, std::span<std::array<uint32_t, 3>> out) const;

 private:
  using Face = std::array<uint32_t, 3>;
  Subdivision(const BaseMesh& mesh, double edgeLength) : mesh_(mesh), edgeLength_(edgeLength) {}
  void addTriangles(uint64_t firstVertex);
  uint32_t cuts(size_t triangle, size_t side) const;

  size_t edgePoints(uint64_t first, std::span<SurfacePoint> out) const;
  size_t gridPoints(uint64_t first, std::span<SurfacePoint> out) const;
  uint32_t sideVertex(size_t triangle, size_t side, uint32_t step) const;
  uint32_t gridVertex(size_t triangle, uint64_t row, uint64_t column) const;
  uint32_t gridSideVertex(size_t triangle, size_t side, uint32_t step) const;
  void facesOf(size_t triangle, uint64_t first, std::span<Face> out) const;
  void fanFaces(size_t triangle, uint64_t first, std::span<Face> out) const;
  void gridFaces(size_t triangle, uint64_t first, std::span<Face> out) const;
  void stripFaces(size_t triangle, size_t side, uint64_t first, std::span<Face> out) const;

  const BaseMesh& mesh_;
  double edgeLength_;
  std::vector<uint32_t> rows_;           // n of each triangle; below 3: no grid
  std::vector<uint64_t> edgeFirst_;      // first vertex of each edge, and the end
  std::vector<uint64_t> interiorFirst_;  // first vertex of each triangle's grid, and the end
  std::vector<uint64_t> faceFirst_;
};

}  // namespace farcell
