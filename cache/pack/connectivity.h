// Which vertices make a page's triangles, in about four bits a triangle: most share an edge with one of the last few.
//
// A list holds the 16 edges met last, each as the neighbour on its other side would walk it. A triangle that has one of
// them is a code (which edge, at which corner it starts) and one corner; any other is a code and three corners. A
// corner is the distance below the next vertex not yet named, so that in an order of first use 0 is a new vertex.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "cache/base/result.h"
#include "cache/pack/words.h"

namespace farcell {

// Of each vertex that came into the mesh as the third corner of a triangle with a known edge: that edge, and the vertex
// across it. Most surfaces make a parallelogram of the four.
using Parallelograms = std::vector<Parallelogram>;

struct ConnectivityCodes {
  std::vector<uint8_t> triangles;  // one a triangle: 3 * edge + rotation, or kNoSharedEdge
  std::vector<uint32_t> corners;   // zigzag differences
  Parallelograms parallelograms;
};

struct DecodedTriangles {
  std::vector<uint32_t> indices;
  Parallelograms parallelograms;
};
inline constexpr uint32_t kEdgeListSize = 16;
inline constexpr uint8_t kNoSharedEdge = 3 * kEdgeListSize;

// REQUIRES: three indices a triangle, below vertexCount.
ConnectivityCodes codedTriangles(std::span<const uint32_t> indices, size_t vertexCount);

// How many corners follow these codes; corrupt when a code is above kNoSharedEdge.
Result<size_t> cornerCount(std::span<const std::byte> triangleCodes);

// REQUIRES: corners.size() == cornerCount(triangleCodes). corrupt when an edge or a vertex does not exist.
Result<DecodedTriangles> decodedTriangles(std::span<const std::byte> triangleCodes, std::span<const uint32_t> corners,
                                          uint32_t vertexCount);

// Starts each triangle at the corner that codes best; order and winding stay.
void rotateForCoding(std::span<uint32_t> indices);

}  // namespace farcell
