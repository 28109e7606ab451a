// Cuts that follow the camera without a pop: each of a pixel's samples is shown a cut of its own.
//
// The cuts are of details a little apart, and choose nearest views from directions a little apart. Where the cuts
// agree, as they do in most of a picture, a cell is drawn once for all samples; where the camera is about to leave one
// way of drawing a cell for another - impostor, children, mesh, triangles, the next view - some samples have left
// before the others. Each sample shows one whole cut: nothing is drawn twice in it and nothing is left out, whatever
// rule chose the cut. What a sample shows depends on the camera alone: no state, a still picture stays.
#pragma once

#include "runtime/selection/selection.h"

namespace farcell {

// Entries that several shares have in common are one; those of no use to a share lie between, in an order that is front
// to back for each share. `triangles` is the sum of what is drawn; work, loss and
// what is hidden are those of one share.
Cut selectHandOver(const Directory& directory, const Camera& camera, int width, int height,
                   const SelectionSettings& settings, const HiddenCells* hidden = nullptr);

}  // namespace farcell
