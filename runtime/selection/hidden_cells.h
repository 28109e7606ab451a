// What selection is told of cells that nearer ones hide.
#pragma once

#include <cstdint>

namespace farcell {

class HiddenCells {
 public:
  virtual ~HiddenCells() = default;
  // Nothing of the cell, however it is drawn, would be seen.
  virtual bool hides(uint32_t cell) const = 0;
  // It is by this leaf's triangles that others are hidden: it stays drawn in full.
  virtual bool needs(uint32_t cell) const = 0;
};

}  // namespace farcell
