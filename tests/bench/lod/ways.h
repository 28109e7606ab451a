// Ways of simplifying a cell that are compared: the one that a build uses, and what it was chosen over.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "preprocess/lod/simplify_cell.h"

namespace farcell::bench {

struct Way {
  std::string name;
  std::function<Result<SimplifiedCell>(const Grid&, const CellKey&, std::span<const LodMesh>, double, uint64_t target)>
      simplify;
};

std::vector<Way> ways();

}  // namespace farcell::bench
