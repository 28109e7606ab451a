// The textures of a part of a leaf as one image of its own, with coarser levels: what near triangles look at.
//
// 1. charts.h: which rectangles of which textures.
// 2. packing.h: where they lie, each with a gutter around it of half a texel of the coarsest level, filled from the
//    texture itself, and none sharing a texel of that level with another.
// 3. Texels are filtered from the source. They are as fine as the source, or less where all would not fit into
//    kMaxTextureEdge^2: the largest charts give way first.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "cache/pack/pages.h"
#include "preprocess/mesh/texture_sampler.h"
#include "preprocess/partition/grid_triangles.h"

namespace farcell {

struct Atlas {
  TexturePage image;                                 // all levels
  std::vector<std::array<uint32_t, 3>> coordinates;  // of each triangle's corners, as GeometryPage has them
};

// Nothing when no triangle has a texture that could be read, or when there are so many charts that they cannot be
// placed however small: then vertex colours are what is left. Triangles without a texture look at white.
std::optional<Atlas> atlasOf(std::span<const TriangleTexture> textures, TextureSampler& sampler);

// The memory that takes at most, beside 150 bytes a triangle.
inline constexpr uint64_t kAtlasBytes = uint64_t{48} << 20;

}  // namespace farcell
