// What a cut loses for a pixel of a cell, by how the cell is drawn: the image error to expect.
#pragma once

#include "cache/pack/directory.h"

namespace farcell {

// 1 is what full geometry at one sample a pixel has on average (ErrorTable). As the build measured it; of a cell whose
// errors are not known, two lines that lie between a city and a statue (tests/bench/cut/results.md).
// texelPixels: edge of a texel of the cell's views; errorPixels: geometric error of its mesh, on screen.
double impostorLoss(const CellRecord& cell, double texelPixels);  // kind A
double meshLoss(const CellRecord& cell, double texelPixels, double errorPixels);

}  // namespace farcell
