// Memory for pages of one size, taken from the system as it is needed, in its largest pages: on many machines getting
// memory costs more than filling it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "cache/base/result.h"

namespace farcell {

class PageArena {
 public:
  // Address space for maxBytes; pageBytes is a power of two.
  static Result<PageArena> create(uint64_t maxBytes, uint64_t pageBytes);
  PageArena(PageArena&& other) noexcept;
  PageArena& operator=(PageArena&& other) noexcept;
  PageArena(const PageArena&) = delete;
  PageArena& operator=(const PageArena&) = delete;
  ~PageArena();

  // A page of any content. REQUIRES: fewer than maxBytes / pageBytes of them are taken.
  std::byte* take();
  void give(std::byte* page) { warm_.push_back(page); }
  // Lets the system have what was given back.
  void trim();

 private:
  PageArena(std::byte* region, uint64_t regionBytes, uint64_t pageBytes);

  std::byte* region_ = nullptr;
  uint64_t regionBytes_ = 0;
  uint64_t pageBytes_ = 0;
  uint64_t untouched_ = 0;        // offset in the region: from here on nothing was taken yet
  std::vector<std::byte*> warm_;  // given back, still with memory behind them
  std::vector<std::byte*> cold_;  // given back, without
};

}  // namespace farcell
