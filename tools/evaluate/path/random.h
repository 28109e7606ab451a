// Numbers drawn for generated paths: the same everywhere for the same seed.
#pragma once

#include <random>

namespace farcell {

// In [low, high).
inline double drawn(std::mt19937& random, double low, double high) {
  return low + (high - low) * (static_cast<double>(random()) / 4294967296.0);
}

}  // namespace farcell
