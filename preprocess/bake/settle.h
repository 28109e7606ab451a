// Settling: the samples that a chunk's triangles won get their colour, and the chunk's memory may go away.
//
// Sunlight does not depend on the viewer. A flat triangle's lit colour is linear across it unless it has a texture:
// large triangles get a *colour plane* and their samples are read off it; a small triangle's few samples are
// interpolated one by one, as are all samples of textured triangles, and where normals differ from corner to corner or
// are baked themselves.
#pragma once

#include <glm/vec3.hpp>
#include <optional>
#include <span>
#include <vector>

#include "preprocess/bake/projection.h"
#include "preprocess/bake/view_baker.h"

namespace farcell::bake {

// A lit colour across the image: value + (x - originX) gradientX + (y - originY) gradientY, within [low, high];
// kColourOne is 1.
struct ColourPlane {
  float value[3], gradientX[3], gradientY[3], low[3], high[3];
  float originX, originY;
};

// Samples of a texel row that wait for their colour.
struct SampleList {
  std::vector<uint32_t> samples;    // element, from the row's first
  std::vector<uint32_t> triangles;  // in the chunk
  size_t count = 0;
};

struct SettleScratch {
  std::vector<ColourPlane> planes;  // by slot
  SampleList single;                // those that are coloured one by one
};

struct Winners {
  const CellSoup& chunk;
  const Projection& projection;
  std::optional<glm::vec3> sun;                          // nothing: colours are albedo
  std::span<const uint32_t> largeTriangles, largeSlots;  // rasterise.h
  TextureSampler* textures;                              // null: the chunk has none
};

// touched: the texels that the chunk may have won samples of.
void settle(const Winners& winners, const TexelRect& touched, SampleImage& image, SettleScratch& scratch);

// GeometryPage's coding of a unit vector: two snorm16.
uint32_t packedOctahedral(glm::vec3 unit);
glm::vec3 unitFromPacked(uint32_t packed);

}  // namespace farcell::bake
