// A walk between buildings. Heights of the model are taken on a grid of columns; of many straight lines near the ground
// the one is taken that meets the fewest columns that stand in its way, and of those the one with the most beside it.
#pragma once

#include <random>
#include <vector>

#include "cache/pack/pack_file.h"
#include "runtime/camera/camera.h"

namespace farcell {

// Lengths in the model's horizontal diagonal: in a city two kilometres across, 2 m above the ground at .5 m a frame.
inline constexpr double kStreetEyeHeight = 1.0 / 1000;
inline constexpr double kStreetStep = 1.0 / 4000;

// Reads every leaf once, one at a time. Ends with `cancelled` on Ctrl-C.
Result<std::vector<Camera>> streetPath(const PackFile& pack, int count, std::mt19937& random);

}  // namespace farcell
