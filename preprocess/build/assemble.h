// From what the jobs have finished to the pack.
#pragma once

#include <functional>

#include "cache/base/progress.h"
#include "cache/pack/directory.h"
#include "preprocess/build/build_context.h"

namespace farcell {

// Writes the pages of every cell in file order, with the views that `kept` names of those that were stored, and the
// directory; fills in what the directory says of pages and views. The size of the pack.
Result<uint64_t> assemblePack(const BuildContext& context, const std::filesystem::path& pack,
                              const std::function<bool(uint32_t cell, uint32_t view)>& kept, Directory& directory,
                              Progress& progress);

}  // namespace farcell
