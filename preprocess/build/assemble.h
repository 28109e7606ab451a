// From what the jobs have finished to the pack.
#pragma once

#include <filesystem>
#include <span>

#include "cache/base/progress.h"
#include "cache/pack/directory.h"
#include "preprocess/build/build_context.h"
#include "preprocess/choose/choose.h"

namespace farcell {

// Writes the pages of every cell in file order, with the views whose fate is to be kept, and the directory; fills in
// what the directory says of pages and views. The size of the pack. views: all of the store; fates: of each.
Result<uint64_t> assemblePack(const BuildContext& context, const std::filesystem::path& pack,
                              std::span<const ViewCost> views, std::span<const ViewFate> fates, Directory& directory,
                              Progress& progress);

}  // namespace farcell
