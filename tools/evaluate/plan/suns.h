// Suns for measuring what relightable views lose under lights they were not built for.
#pragma once

#include <vector>

#include "cache/schema/model.h"

namespace farcell {

// `count` of at least 1, spread evenly over the sky: elevations by equal areas, azimuths by the golden angle. None
// stands on the horizon or straight above.
std::vector<Sun> skySuns(int count);

}  // namespace farcell
