// The leaves a camera can see, in the order in which rays meet them.
#pragma once

#include <cstdint>
#include <vector>

#include "cache/pack/directory.h"
#include "tools/evaluate/reference/view.h"

namespace farcell {

struct VisibleLeaf {
  uint32_t cell = 0;    // index into Directory::cells
  ScreenBounds bounds;  // of its content
};

// Front to back: along any ray from the eye, no leaf comes after one that lies behind it. Leaves without triangles and
// leaves outside the picture are left out.
std::vector<VisibleLeaf> leavesFrontToBack(const Directory& directory, const ReferenceView& view);

}  // namespace farcell
