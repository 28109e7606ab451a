// The colours of FLIP's maps, as its authors show them: dark is equal, pale is different.
#pragma once

#include <array>
#include <cstdint>

namespace farcell {

// R, G, B of a value in [0, 1].
std::array<uint8_t, 3> magma(float value);

}  // namespace farcell
