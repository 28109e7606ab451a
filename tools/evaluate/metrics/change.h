// What moves between two frames that should not: a picture's change against the change of the truth.
#pragma once

#include <span>
#include <vector>

namespace farcell {

// A renderer's picture of a frame and the reference's, composited over one background: 3 a pixel, 0-255.
struct FramePair {
  std::span<const float> own;
  std::span<const float> reference;
};

// Means over all pixels and channels of the image, 0-255.
struct Change {
  double own = 0;        // |change of the picture|
  double reference = 0;  // |change of the reference|
  double flicker = 0;    // |change of the picture - change of the reference|
};

// map: gets |change of the picture - change of the reference|, 3 a pixel; null: not wanted.
// REQUIRES: four pictures of one size, not empty.
Change measureChange(const FramePair& before, const FramePair& now, std::vector<float>* map = nullptr);

}  // namespace farcell
