// The lit colour of a large flat triangle, across the image.
#pragma once

#include "preprocess/bake/settle.h"

namespace farcell::bake {

// Lights the triangle (shading.h) and finds the plane through its corners' colours. REQUIRES: a projected area.
ColourPlane colourPlane(const Winners& winners, uint32_t triangle);

}  // namespace farcell::bake
