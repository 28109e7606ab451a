// From the cells that were measured to what is expected of all: the tables that a pack keeps.
#pragma once

#include <map>
#include <span>
#include <vector>

#include "cache/pack/directory.h"
#include "preprocess/measure/measure_cell.h"
#include "preprocess/measure/regression.h"

namespace farcell {

// Of a cell's views that are not empty, means a view: coded bytes, texels with anything and those of them that are
// covered in part.
struct ViewFigures {
  double views = 0;
  double bytes = 0;
  double coveredTexels = 0;
  double edgeTexels = 0;
};

// What the error of a cell is expected by: triangles a texel, silhouette share, bytes a texel (what there is to be
// seen), size, how much of its box it fills, level, and of its mesh the geometric error and how much it was simplified.
Features featuresOf(const Model& model, const CellRecord& cell, const ViewFigures& views);

// How far what is expected was from what was measured, each cell left out in turn: |expected / measured - 1|.
struct ExpectedApart {
  size_t cells = 0;
  double median = 0;
  double ninetieth = 0;  // of a hundred
};

struct ExpectedErrors {
  double unit = 0;                 // ErrorTable's 1, |dR| + |dG| + |dB| a pixel
  std::vector<ErrorTable> tables;  // by cell; empty where nothing was measured
  std::array<std::array<ExpectedApart, kErrorScales>, kErrorWays> apart{};
};

// cells: with meshTriangles and geometricError. views: of each cell. measured: by cell.
ExpectedErrors expectErrors(const Model& model, std::span<const CellRecord> cells, std::span<const ViewFigures> views,
                            const std::map<uint32_t, CellErrors>& measured);

}  // namespace farcell
