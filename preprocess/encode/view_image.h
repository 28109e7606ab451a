// From a baked view to what a pack keeps of it.
#pragma once

#include <cstdint>

#include "cache/pack/pages.h"
#include "preprocess/bake/view_baker.h"

namespace farcell {

// Quantises to 8 bits a channel (depth over the view's own range: measured without loss) and grows the depth, not the
// coverage, by one texel into the empty ones around it, so that a ray which meets the surface at its very edge finds
// it. An empty view gives a ViewImage of no size.
ViewImage quantisedView(const BakedView& baked, uint32_t view, int imageSize);

}  // namespace farcell
