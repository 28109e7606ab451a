// Smooth noise in space, for relief and stains.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>

namespace farcell {

// Gradient noise (Perlin, Improving Noise, 2002) in [-1, 1], 0 on the whole-number lattice; features are 1 wide. The
// same bits on every machine. REQUIRES: |place| < 2^31.
float gradientNoise(uint32_t key, glm::dvec3 place);

}  // namespace farcell
