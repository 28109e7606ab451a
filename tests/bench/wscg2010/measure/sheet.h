// Pictures beside each other.
#pragma once

#include <vector>

#include "runtime/frame_image.h"
#include "tools/image/png.h"

namespace farcell::wscg {

// RGB over black.
Picture pictureOf(const FrameImage& image);
// |a - b|, channel by channel. REQUIRES: the same size.
Picture difference(const Picture& a, const Picture& b);
// Pictures of one size, at a third of it, `columns` a row, a thin line between them. REQUIRES: at least one.
Picture contactSheet(const std::vector<Picture>& pictures, int columns);

}  // namespace farcell::wscg
