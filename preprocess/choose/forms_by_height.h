// Forms of views that go by a cell's height: how far it is above the leaves.
//
// A leaf is what is left to triangles when its texels are too coarse: large images let it stand in at half the
// distance, few directions keep that in the bytes; what these get wrong, the depth corrects the better the smaller the
// cell. Cells higher up have a quarter of the bytes of those below them: there many directions of large images cost
// little, and a whole model at a distance shows what is wrong with few (tests/bench/figures/forms.md).
#pragma once

#include <span>

#include "cache/pack/directory.h"

namespace farcell {

// A viewpoint set between two others, and images that can be twice as large.
bool isBaseOfHeights(const ViewForm& base);

// A leaf: the next smaller set, images twice as large; its parent: `base`; above that: images twice as large, from the
// third on of the next larger set. A cell is as high as the highest of its children asks for. REQUIRES:
// isBaseOfHeights; parents before children.
void setFormsByHeight(const ViewForm& base, std::span<CellRecord> cells);

}  // namespace farcell
