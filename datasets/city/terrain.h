// The gently rolling ground.
#pragma once

#include <cstdint>

namespace farcell::city {

// Metres above zero; slopes stay under 8 %.
double groundHeight(uint64_t seed, double x, double y);
// Smooth noise in [0, 1] whose features are `scaleM` wide.
double smoothNoise(uint64_t key, double x, double y, double scaleM);

}  // namespace farcell::city
