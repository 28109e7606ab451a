// What impostors of other forms would show of a cell, and take: what the form of its kind of cells is chosen by.
#pragma once

#include "preprocess/measure/measure_cell.h"

namespace farcell {

inline constexpr std::array<int, 4> kCandidateViews = {12, 42, 162, 642};
inline constexpr std::array<int, 3> kCandidateSizes = {64, 128, 256};
inline constexpr size_t kCandidates = kCandidateViews.size() * kCandidateSizes.size();
// By size, then number of views.
ViewForm candidateForm(size_t candidate);

// Edges of the pictures that a cell is measured in, pixels over the part of its plane that a view shows. A view is used
// where a pixel is two of its texels or more: larger pictures of it stay without covered pixels.
inline constexpr std::array<int, 4> kPictureEdges = {16, 32, 64, 128};

struct CandidateErrors {
  std::array<ErrorSum, kPictureEdges.size()> depthCorrected{}, blended{};
  double bytes = 0;  // of all its views, coded, with their headers
};

// Sums over measuredDirections() and their antipodes, by kPictureEdges.
struct CellCandidates {
  std::array<ErrorSum, kPictureEdges.size()> single{};     // full geometry at one sample a pixel
  std::array<ErrorSum, kPictureEdges.size()> triangles{};  // the cell's own, at four
  std::array<CandidateErrors, kCandidates> forms{};
};

// Settings but the form are those of all candidates. cell: without a mesh.
Result<CellCandidates> measureCandidates(const MeasuredCell& cell, const MeasureSettings& settings);

}  // namespace farcell
