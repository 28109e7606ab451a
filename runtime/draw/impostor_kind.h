// How an impostor is drawn.
#pragma once

namespace farcell {

enum class ImpostorKind {
  flat,            // the billboard of the 2010 paper: one view on a plane through the middle of the cell's content
  depthCorrected,  // kind A: rays corrected by the depth of the nearest view; the second nearest where that saw nothing
  blended,         // kind B: A, and at the point that a ray meets, the mean of the three views around the direction to
                   // the eye that see the point, weighed by how near they are
};

}  // namespace farcell
