// Jobs that bake the views of a cell and code them.
#pragma once

#include <vector>

#include "preprocess/build/build_context.h"

namespace farcell {

// A leaf of fewer triangles gets no views: they would cost more bytes than they can save time. The bound is low because
// a single triangle in a frame makes the renderer multisample all of it.
inline constexpr uint64_t kTrianglesCheaperThanView = 4;

// Up to here a cell's triangles are gathered once and every view is baked from memory; beyond, leaves are streamed
// past all views at once. Both give the same views.
inline constexpr uint64_t kGatherTriangles = 500'000;

// All batches of a model, those of the most work first, without cells that are empty or cheaper as triangles. A batch
// is a few seconds of work at most, unless a single pair of views is more: that is what a crash may lose, for each
// thread. Depends on the tree and the viewpoints alone; views that are not wanted are left out when a batch is baked.
std::vector<ViewBatch> viewBatches(const BuildContext& context);
// A leaf of so few triangles that it gets no views.
bool cheaperAsTriangles(const CellRecord& cell);
// Whether it gets views.
bool isBaked(const CellRecord& cell);

// Bakes, codes and stores a batch; exhausted when the gate has not the memory for one pair of views. textures: those of
// the mesh, a sampler of this thread; null when it has none.
Result<> bakeBatch(const BuildContext& context, const ViewBatch& batch, TextureSampler* textures,
                   uint64_t gatherTriangles = kGatherTriangles);

}  // namespace farcell
