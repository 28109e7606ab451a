// Where one frame draws a part of the model otherwise than the frame before: what may be seen as a pop.
#pragma once

#include "cache/pack/directory.h"
#include "runtime/draw/impostor_kind.h"
#include "runtime/selection/selection.h"

namespace farcell {

struct Switches {
  uint32_t views = 0;   // cells drawn as impostors in both frames, from other views
  uint32_t levels = 0;  // cells in the place of a parent or of children, or drawn as something else
};

// Counted in cells of `now`. A cell of which `before` drew nothing has come into view: no switch. Views are those that
// `kind` draws: one, one and the next, or the three it blends.
Switches countSwitches(const Directory& directory, const Cut& before, const Cut& now, ImpostorKind kind);

}  // namespace farcell
