// A geometry page as the GPU draws it. Positions are integers on the model's grid, so that neighbouring cells agree.
#pragma once

#include <cstdint>
#include <vector>

#include "cache/pack/pages.h"
#include "cache/schema/grid.h"

namespace farcell {

// What a triangle's last corner says in the alpha of its colour.
inline constexpr uint32_t kLit = 0xff000000u;       // an albedo
inline constexpr uint32_t kLitFront = 0x80000000u;  // an albedo, seen from the front only
inline constexpr uint32_t kShown = 0;               // what the triangle shows, whatever the light

struct GpuVertex {
  GridPoint position{0};  // grid steps from the grid's origin
  uint32_t colour = 0;    // 0xAABBGGRR, A of the kinds below
  uint32_t normal = 0;    // octahedral, snorm16 pair; flat faces: of the triangle whose last corner this is
};
static_assert(sizeof(GpuVertex) == 20);

struct GpuMesh {
  std::vector<GpuVertex> vertices;
  std::vector<uint32_t> coordinates;  // of each vertex on the page's atlas, two unorm16; empty: it has none
  std::vector<uint32_t> indices;      // three a triangle; the last corner is the provoking one
};

// `origin`: the lowest corner of the cell's cube. A page without normals has flat faces: each triangle is rotated so
// that its last corner carries its normal; a corner is copied only when all three carry other triangles' normals.
GpuMesh makeGpuMesh(const GeometryPage& page, GridPoint origin);

// Edges of the atlas that lie along a grid step, on average over the surface: a texel is a step divided by that and by
// the atlas's edge. 0 where nothing looks at the atlas.
double atlasEdgesPerStep(const GeometryPage& page);

// Unit normal of a triangle on the grid, exact up to the last rounding; of a triangle without area: +z.
glm::vec3 faceNormal(GridPoint a, GridPoint b, GridPoint c);

}  // namespace farcell
