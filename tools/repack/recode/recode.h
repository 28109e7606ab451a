// A pack written again in fewer bytes.
#pragma once

#include <cstdint>
#include <filesystem>

#include "cache/base/progress.h"
#include "cache/pack/pack_file.h"

namespace farcell {

struct PackBytes {
  uint64_t pack = 0;
  uint64_t impostors = 0;
  uint64_t geometry = 0;
  uint64_t textures = 0;
};

struct RecodeResult {
  PackBytes before;
  PackBytes after;
  uint64_t pages = 0;
};

// Codes every page again at the slowest effort and writes the pack to `output`, which appears when it is whole and may
// be the pack itself. Nothing else changes: cells, pages and settings are those of `pack`, and each page is decoded and
// compared with what it was before it is written (corrupt where one differs). Same bytes for any number of threads (0:
// all). cancelled after an interrupt.
Result<RecodeResult> recodePack(const PackFile& pack, const std::filesystem::path& output, int threads,
                                Progress& progress);

}  // namespace farcell
