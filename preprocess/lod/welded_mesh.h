// The meshes of a cell's children as one: a position that several vertices share is one place.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "cache/base/result.h"
#include "preprocess/lod/lod_mesh.h"

namespace farcell::lod {

using Triangle = std::array<uint32_t, 3>;

inline constexpr uint32_t kAsCorners = UINT32_MAX;

struct WeldedMesh {
  GridBox box;                             // the cell's cube
  std::vector<GridPoint> places;           // each position once
  std::vector<uint8_t> faces;              // of a place: the faces of the cube it lies on (bit 2 axis + side); 0: free
  std::vector<Triangle> triangles;         // places, three different ones each
  std::vector<Triangle> corners;           // the same triangles' vertices
  std::vector<uint32_t> shown;             // of the triangles, as in GeometryPage; kAsCorners: what the corners say
  std::vector<uint32_t> placeOfVertex;     // a vertex is a place with a colour and a normal
  std::vector<uint32_t> colours, normals;  // of the vertices; empty when the model has none
};

// invalidArgument for a child that contradicts itself, its siblings or the cell's cube.
Result<WeldedMesh> weld(const GridBox& box, std::span<const LodMesh> children);

}  // namespace farcell::lod
