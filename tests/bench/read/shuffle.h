// The worst order a file can have.
#pragma once

#include <filesystem>

#include "cache/base/result.h"

namespace farcell {

// A binary PLY file whose last element is triangles of 13 bytes a row: the same with these rows in random order, always
// the same one. Holds the rows in memory.
Result<> shufflePly(const std::filesystem::path& from, const std::filesystem::path& to);

}  // namespace farcell
