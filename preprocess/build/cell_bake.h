// All pages of one cell: its views baked and coded, and for a leaf its triangles.
#pragma once

#include <cstddef>
#include <vector>

#include "cache/pack/directory.h"
#include "cache/schema/viewpoints.h"
#include "preprocess/build/soup.h"
#include "preprocess/mesh/texture_sampler.h"

namespace farcell {

// A leaf of fewer triangles gets no views: they would cost more bytes than they can save time. No more than a few: a
// single triangle in a frame makes the renderer multisample all of it.
inline constexpr uint64_t kTrianglesCheaperThanView = 4;

// Up to here a cell's triangles are gathered once and every view is baked from memory; beyond, leaves are streamed
// past all views at once. Both give the same views.
inline constexpr uint64_t kGatherTriangles = 2'000'000;

struct EncodedPage {
  PageKind kind;
  uint32_t group;
  uint32_t decodedBytes;
  std::vector<std::byte> bytes;
};

struct CellPages {
  std::vector<EncodedPage> pages;  // geometry first, then views by rising group
  uint64_t viewsBaked = 0;
  uint64_t viewsKept = 0;
  uint64_t viewsEmpty = 0;
  uint64_t viewsCheaperAsTriangles = 0;
  uint64_t impostorRawBytes = 0;
  double bakeSeconds = 0;  // of this thread
  double encodeSeconds = 0;
};

// textures: those of the mesh, a sampler of this thread; null when it has none.
Result<CellPages> bakeCell(uint32_t cell, const Model& model, const CellTree& tree, const Partition& partition,
                           const Viewpoints& viewpoints, TextureSampler* textures,
                           uint64_t gatherTriangles = kGatherTriangles);

}  // namespace farcell
