// A cropped view as a whole square image with its mip chain, ready for a texture layer.
#pragma once

#include <cstdint>
#include <vector>

#include "cache/pack/pages.h"

namespace farcell {

// Levels of an image of `imageSize` (a power of two) texels down to 1 x 1.
int mipLevelCount(int imageSize);

// RGBA8, premultiplied; level k has (imageSize >> k)^2 texels. Each texel is the mean of the four below it: averages
// are taken in the space of shading.h. Outside the crop everything is transparent.
std::vector<std::vector<uint8_t>> buildColourMips(const ViewImage& view, int imageSize);

// imageSize^2 depth values, 0 outside the crop.
std::vector<uint8_t> buildDepthImage(const ViewImage& view, int imageSize);
// The mean vectors of the normals, premultiplied by coverage as colours are, with mips alike: x, y, z as snorm8 and 0.
// REQUIRES: the view has normals.
std::vector<std::vector<int8_t>> buildNormalMips(const ViewImage& view, int imageSize);

}  // namespace farcell
