// From samples to texels.
#pragma once

#include "preprocess/bake/sample_image.h"
#include "preprocess/bake/view_baker.h"

namespace farcell::bake {

// The two images of samples that are all settled. Sums are of integers, so that the order of a texel's samples, which
// is another one for the antipode, makes no difference.
void resolve(const SampleImage& image, BakedView& view, BakedView& antipode);

}  // namespace farcell::bake
