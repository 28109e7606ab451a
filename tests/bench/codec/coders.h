// Coders that a view's bytes could be given to, for comparison.
#pragma once

#include <cstdint>
#include <vector>

#include "cache/pack/pages.h"

namespace farcell {

struct CoderTotals {
  const char* name = "";
  const char* input = "";  // "planes": what our coding makes of the texels; "texels": rgba, then depth, then normals
  int level = 0;
  uint64_t rawBytes = 0;  // of texels, whatever the input
  uint64_t storedBytes = 0;
  double encodeSeconds = 0;  // of the coder alone, without the planes
  double decodeSeconds = 0;
};

// Nothing coded yet; the first is ours.
std::vector<CoderTotals> otherCoders();
// REQUIRES: the view is not empty.
void addView(const ViewImage& view, std::vector<CoderTotals>& totals);

}  // namespace farcell
