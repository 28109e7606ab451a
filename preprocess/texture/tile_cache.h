// The tiles that one thread looked at last.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "cache/base/file.h"
#include "preprocess/texture/pyramid.h"

namespace farcell {

// Sets of four tiles; a tile's index says its set, and the one that was read longest ago gives way.
class TileCache {
 public:
  static constexpr size_t kWays = 4;
  static constexpr size_t kSets = 1024;  // 16 MiB of tiles, occupied as they are read

  // `file`: tile after tile; must outlive the cache.
  explicit TileCache(const ScratchFile* file);

  // kTilePixels pixels, valid until the next call. After a failure they may be anything.
  const uint32_t* tile(uint64_t index) { return index == lastIndex_ ? last_ : find(index); }
  const std::optional<Error>& failure() const { return failure_; }

 private:
  static constexpr uint64_t kNone = ~uint64_t{0};
  struct Set {
    std::array<uint64_t, kWays> tiles;
    size_t next = 0;  // to give way
  };
  const uint32_t* find(uint64_t index);

  const ScratchFile* file_;
  std::unique_ptr<uint32_t[]> pixels_;
  std::vector<Set> sets_;
  uint64_t lastIndex_ = kNone;
  const uint32_t* last_ = nullptr;
  std::optional<Error> failure_;
};

}  // namespace farcell
