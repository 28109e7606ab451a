// Rows of an OFF file: a vertex or a face a line.
#pragma once

#include <vector>

#include "preprocess/mesh/vertices.h"
#include "preprocess/read/off/off_colour.h"
#include "preprocess/read/off/off_header.h"

namespace farcell {

// All vertices; `lines` is at the last line of the header.
Result<Vertices> readOffVertices(TextLines& lines, const OffHeader& header, const std::shared_ptr<ReadMemory>& memory);

struct OffFace {
  std::vector<int64_t> corners;  // as written
  bool hasColour = false;
  OffColour colour;
};
// The next face, number `index` of them. `face` is used again for its memory.
Result<> readOffFace(TextLines& lines, const OffHeader& header, uint64_t index, OffFace& face);

}  // namespace farcell
