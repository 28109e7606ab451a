// The model that costs are measured with: a sphere in eight leaves, views of all but one, which stays triangles.
#pragma once

#include <filesystem>

#include "cache/base/result.h"

namespace farcell {

// Of radius 1 around (0, 0, 0).
Result<> writeBallPack(const std::filesystem::path& path);

}  // namespace farcell
