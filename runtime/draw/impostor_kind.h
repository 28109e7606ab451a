// How an impostor is drawn.
#pragma once

namespace farcell {

enum class ImpostorKind {
  flat,            // the billboard of the 2010 paper: one view on a plane through the middle of the cell's content
  depthCorrected,  // kind A: rays corrected by the depth of the nearest view; the second nearest where that saw nothing
};

}  // namespace farcell
