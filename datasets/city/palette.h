// A colour of a list, a little lighter or darker.
#pragma once

#include "datasets/city/mesh.h"
#include "datasets/random/random.h"

namespace farcell::city {

template <size_t kCount>
Colour pickColour(const std::array<Colour, kCount>& palette, double darkest, double lightest, Random& random) {
  const Colour colour = palette[static_cast<size_t>(random.below(static_cast<int>(kCount)))];
  return scaled(colour, random.range(darkest, lightest));
}

}  // namespace farcell::city
