#include "preprocess/texture/tile_cache.h"

#include <span>

namespace farcell {

TileCache::TileCache(const ScratchFile* file)
    : file_(file),
      pixels_(std::make_unique_for_overwrite<uint32_t[]>(kSets * kWays * kTilePixels)),
      sets_(kSets, Set{{kNone, kNone, kNone, kNone}, 0}) {}

const uint32_t* TileCache::find(uint64_t index) {
  const size_t at = index % kSets;
  Set& set = sets_[at];
  size_t way = 0;
  while (way < kWays && set.tiles[way] != index) ++way;
  const bool known = way < kWays;
  if (!known) {
    way = set.next;
    set.next = (set.next + 1) % kWays;
    set.tiles[way] = index;
  }
  uint32_t* pixels = pixels_.get() + (at * kWays + way) * kTilePixels;
  if (!known) {
    const auto read =
        file_->readAt(index * kTilePixels * sizeof(uint32_t), std::as_writable_bytes(std::span(pixels, kTilePixels)));
    if (!read && !failure_) failure_ = read.error();
  }
  lastIndex_ = index;
  last_ = pixels;
  return pixels;
}

}  // namespace farcell
