// Jobs that measure the image error of some cells (preprocess/measure), of which the others' is expected.
#pragma once

#include <vector>

#include "preprocess/build/build_context.h"
#include "preprocess/measure/expect_errors.h"

namespace farcell {

// REQUIRES: measure is not off. Of Measure::sample every fiftieth cell, but at least kUsuallyMeasured or, where those are
// more than a quarter of all, that quarter (measuring should not take longer than the rest of the build), and
// between kLeastMeasured and kMostMeasured; evenly spread over levels and, within each, over numbers of triangles; of Measure::all each. Cells
// without views, and those of more than kMaxMeasuredTriangles, are not among them. Depends on the tree alone.
inline constexpr uint64_t kMaxMeasuredTriangles = 120'000;  // measured in the least memory that a build may have
inline constexpr size_t kLeastMeasured = 6;
inline constexpr size_t kUsuallyMeasured = 24;
inline constexpr size_t kMostMeasured = 400;
inline constexpr size_t kMostAlternatives = 32;
struct MeasureJob {
  uint32_t cell = 0;
  bool alternatives = false;  // other views too: of every fourth, or of kMostAlternatives
};
std::vector<MeasureJob> measureJobs(const CellTree& tree, Measure measure);

// REQUIRES: mesh and views of the cell are there.
Result<> measureStored(const BuildContext& context, const MeasureJob& job, TextureSampler* textures);

// Means over the views of each cell that are not empty. costs: by cell.
std::vector<ViewFigures> viewFigures(size_t cells, std::span<const ViewCost> costs);

}  // namespace farcell
