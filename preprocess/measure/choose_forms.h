// Which form the views of each kind of cells have, by what was measured of some.
//
// A kind is the cells of a level that are leaves, or that are not: one distance shows them in one size. Walking away
// from the model, a picture edge of R pixels over a cell's views falls by half each octave of distance and each level.
// A cell of image size s is drawn by its views from where its parent's are too coarse, R > sp / 4 (sp the parent's
// image size), to R = s / 2; nearer, an inner cell by its children, a leaf by its triangles. No
// cell has smaller images than its parent: the parent's views would have to do for its own, but a larger cell comes
// near with its nearest point first. What is minimised is the sum over octaves of distance of the error to expect, as a
// multiple of full geometry's at one sample a pixel, each kind by its share of the picture, with no more bytes than
// given: a multiple-choice knapsack, solved exactly over kByteSteps steps of the budget from the deepest level up,
// since a kind meets those above only through its parents' image size.
#pragma once

#include <map>
#include <span>
#include <vector>

#include "cache/pack/directory.h"
#include "preprocess/measure/candidates.h"

namespace farcell {

inline constexpr size_t kByteSteps = 1024;

struct FormKind {
  uint32_t level = 0;
  bool leaf = false;
  auto operator<=>(const FormKind&) const = default;
};
inline FormKind kindOf(const CellRecord& cell) { return {cell.key.level, cell.childCount == 0}; }

// Means over the measured cells of a kind, or of the kind most like it where none was measured.
struct FormMeans {
  std::array<double, kPictureEdges.size()> triangles{};                            // multiples of single's
  std::array<std::array<double, kPictureEdges.size()>, kCandidates> candidates{};  // likewise, kind A; 0: too coarse
  std::array<std::array<double, kPictureEdges.size()>, kCandidates> blended{};     // kind B
  std::array<double, kCandidates> bytes{};                                         // of a cell
};

struct KindForms {
  FormKind kind;
  uint64_t cells = 0;
  uint64_t measured = 0;  // of them; 0: the means are those of a kind like it
  double share = 0;       // of the picture, at the distances where the kind is drawn
  FormMeans means;
  size_t chosen = 0;  // candidate
};

// The least error to expect of so many bytes.
struct FormsPoint {
  double bytes = 0, error = 0;
};

struct ChosenForms {
  std::vector<KindForms> kinds;    // by level, inner cells first; none where nothing was measured
  FormsPoint chosen, fixed;        // fixed: all cells of the settings' form, whose bytes are the budget
  std::vector<FormsPoint> pareto;  // of a part of the budget up to all of it, by rising bytes
};

// hasViews: of each cell, whether it is baked. REQUIRES: a candidate as the settings' form.
ChosenForms chooseForms(const Model& model, std::span<const CellRecord> cells, const std::vector<bool>& hasViews,
                        const std::map<uint32_t, CellCandidates>& measured);

}  // namespace farcell
