// Image errors to expect of the ways to draw a cell, a pixel of it, in those of full geometry at one sample a pixel
// where triangles are much smaller than pixels. Lines between three models (tests/bench/losses/results.md).
#pragma once

#include "cache/pack/directory.h"

namespace farcell {

// As an impostor whose texel measures so many pixels on screen.
double impostorLoss(const CellRecord& cell, double texelPixels);
// As its mesh, at 4 samples, with a geometric error of so many pixels; 0: in full. What a pixel's samples miss grows
// with the triangles of the full surface in it.
double meshLoss(const CellRecord& cell, double errorPixels, double trianglesPerPixel);

}  // namespace farcell
