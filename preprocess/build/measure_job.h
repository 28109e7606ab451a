// Jobs that measure the image error of some cells (preprocess/measure), of which the others' is expected, and of other
// forms of their views, of which the forms of all are chosen.
#pragma once

#include <vector>

#include "preprocess/build/build_context.h"
#include "preprocess/measure/choose_forms.h"
#include "preprocess/measure/expect_errors.h"

namespace farcell {

// REQUIRES: measure is not off. Of Measure::sample every fiftieth cell, but at least kUsuallyMeasured or, where those
// are more than a quarter of all, that quarter (measuring should not take longer than the rest of the build), and
// between kLeastMeasured and kMostMeasured; evenly spread over levels and, within each, over numbers of triangles; of
// Measure::all each. Cells without views, and those of more than kMaxMeasuredTriangles, are not among them. Depends on
// the tree alone.
inline constexpr uint64_t kMaxMeasuredTriangles = 120'000;  // measured in the least memory that a build may have
inline constexpr size_t kLeastMeasured = 6;
inline constexpr size_t kUsuallyMeasured = 24;
inline constexpr size_t kMostMeasured = 400;
std::vector<uint32_t> cellsToMeasure(const CellTree& tree, Measure measure);

// REQUIRES: mesh and views of the cell are there.
Result<> measureStored(const BuildContext& context, uint32_t cell, TextureSampler* textures);

// Cells of which all candidate forms are measured (candidates.h): of each kind (choose_forms.h) every fiftieth, but at
// least kLeastCandidates and at most kMostCandidates, evenly spread over numbers of triangles; of those that could be
// measured as above. Depends on the tree alone.
inline constexpr size_t kLeastCandidates = 2;
inline constexpr size_t kMostCandidates = 12;
std::vector<uint32_t> cellsOfCandidates(const CellTree& tree);
// Needs neither mesh nor views.
Result<> measureForms(const BuildContext& context, uint32_t cell, TextureSampler* textures);

// Means over the views of each cell that are not empty. costs: by cell.
std::vector<ViewFigures> viewFigures(size_t cells, std::span<const ViewCost> costs);

}  // namespace farcell
