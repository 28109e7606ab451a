// What must hold between the fields of a directory before anything relies on it.
#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "cache/base/result.h"
#include "cache/pack/directory.h"
#include "cache/pack/directory_codec.h"

namespace farcell {

// Stored bytes of pages by kind.
struct PageBytes {
  uint64_t views = 0;
  uint64_t geometry = 0;
  uint64_t textures = 0;
};
PageBytes pageBytes(std::span<const PageRecord> pages);

// The settings are possible; cells form one tree whose content lies inside its cubes; pages follow each other from
// the header to `directoryOffset` without a gap and belong to the cells that name them.
Result<> checkDirectory(const Directory& directory, const DirectoryPlaces& places, uint64_t directoryOffset,
                        const std::string& path);

}  // namespace farcell
