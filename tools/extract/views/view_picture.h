// A baked view as a picture, row 0 at the top.
#pragma once

#include "cache/pack/pages.h"
#include "tools/image/png.h"

namespace farcell {

enum class ViewChannel {
  colour,    // RGBA, not premultiplied: alpha is coverage
  coverage,  // grey
  depth,     // grey as stored: 0 unknown, 1 farthest, 255 nearest (pages.h)
  normal,    // RGBA: direction of the mean normal, world axes, -1..1 as 0..255; alpha is coverage
};

int channelCount(ViewChannel channel);

// The rectangle that holds anything. REQUIRES: the view is not empty; normals for ViewChannel::normal.
Picture viewPicture(const ViewImage& view, ViewChannel channel);

// Of one size and kind of pixel, all zero.
Picture blankPicture(int width, int height, int channels);
// Copies `source` with its upper left corner at (x, y). REQUIRES: it fits, and has as many channels.
void place(const Picture& source, int x, int y, Picture& target);

}  // namespace farcell
