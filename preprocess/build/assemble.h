// From what the jobs have finished to the pack.
#pragma once

#include <filesystem>
#include <span>

#include "cache/base/progress.h"
#include "cache/pack/directory.h"
#include "preprocess/build/build_context.h"
#include "preprocess/choose/choose.h"

namespace farcell {

// Writes the pages of every cell in file order, its mesh, then those of its views whose fate is to be kept, and the
// directory; fills in what the directory says of meshes, pages and views. Returns the size of the pack in bytes.
// views: all of the store, by cell, then view; fates: of each.
Result<uint64_t> assemblePack(const BuildContext& context, const std::filesystem::path& pack,
                              std::span<const ViewCost> views, std::span<const ViewFate> fates, Directory& directory,
                              Progress& progress);

}  // namespace farcell
