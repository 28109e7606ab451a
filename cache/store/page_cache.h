// Decoded pages in memory, within a byte budget.
//
// The life of a request: pin() finds the page (a hit) or marks it as loading, reads and decodes it outside the lock (a
// miss), makes room by evicting the pages unpinned longest, and returns a PagePin. Whoever asks for a page that is
// being loaded waits for that load. A pinned page is never evicted; when its last pin goes it becomes the newest
// candidate.
#pragma once

#include <condition_variable>
#include <cstdint>
#include <list>
#include <memory>
#include <mutex>
#include <optional>
#include <unordered_map>
#include <variant>

#include "cache/base/result.h"
#include "cache/pack/pack_file.h"

namespace farcell {

using DecodedPage = std::variant<GeometryPage, ViewPage, TexturePage>;

// Where pages come from: a pack, or a fake in tests. Called from several threads at once.
class PageSource {
 public:
  virtual ~PageSource() = default;
  virtual uint32_t pageCount() const = 0;
  // What the page is charged with once decoded, and what reading it takes from the file. REQUIRES: page < pageCount().
  virtual uint64_t decodedBytes(uint32_t page) const = 0;
  virtual uint64_t storedBytes(uint32_t page) const = 0;
  virtual Result<DecodedPage> load(uint32_t page) const = 0;
};

// The pages of an opened pack, which must outlive it.
class PackPageSource : public PageSource {
 public:
  explicit PackPageSource(const PackFile& pack) : pack_(pack) {}
  uint32_t pageCount() const override;
  uint64_t decodedBytes(uint32_t page) const override;
  uint64_t storedBytes(uint32_t page) const override;
  Result<DecodedPage> load(uint32_t page) const override;

 private:
  const PackFile& pack_;
};

struct PageCacheStats {
  uint64_t hits = 0;      // pins served from memory, waits for another's load included
  uint64_t misses = 0;    // loads begun
  uint64_t failures = 0;  // loads that ended in an error
  uint64_t refused = 0;   // pins that did not fit beside what is pinned
  uint64_t evictions = 0;
  uint64_t bytesRead = 0;  // stored bytes of loads that succeeded
  uint64_t residentBytes = 0;
  uint64_t pinnedBytes = 0;
  uint64_t maximumBytes = 0;  // the most residentBytes ever was: never above the budget
};

class PageCache;

// Keeps a decoded page in memory while it lives. Move-only; must not outlive its cache. Any thread.
class PagePin {
 public:
  PagePin() = default;  // holds nothing
  PagePin(PagePin&& other) noexcept;
  PagePin& operator=(PagePin&& other) noexcept;
  PagePin(const PagePin&) = delete;
  PagePin& operator=(const PagePin&) = delete;
  ~PagePin();

  explicit operator bool() const { return page_ != nullptr; }
  // REQUIRES: holds a page of that kind.
  const GeometryPage& geometry() const { return std::get<GeometryPage>(*page_); }
  const ViewPage& views() const { return std::get<ViewPage>(*page_); }
  const TexturePage& texture() const { return std::get<TexturePage>(*page_); }

 private:
  friend class PageCache;
  PagePin(PageCache* cache, uint32_t index, const DecodedPage* page) : cache_(cache), index_(index), page_(page) {}
  PageCache* cache_ = nullptr;
  uint32_t index_ = 0;
  const DecodedPage* page_ = nullptr;
};

// Thread-safe. The budget covers decoded pages, those being loaded included; it is never passed.
class PageCache {
 public:
  // `source` must outlive the cache.
  PageCache(const PageSource& source, uint64_t budgetBytes);
  ~PageCache();  // REQUIRES: no pin left
  PageCache(const PageCache&) = delete;
  PageCache& operator=(const PageCache&) = delete;

  // exhausted when the page does not fit beside what is pinned and being loaded: draw something coarser and go on.
  // A failed load is not remembered: the next pin tries again. REQUIRES: page < pageCount().
  Result<PagePin> pin(uint32_t page);
  PageCacheStats stats() const;

 private:
  friend class PagePin;
  // A load under way; those who wait for it keep it alive.
  struct Load {
    bool done = false;
    std::optional<Error> error;
  };
  struct Entry {
    DecodedPage page;
    uint64_t bytes = 0;
    uint32_t pins = 0;                    // those waiting for the load included
    std::shared_ptr<Load> load;           // null once the page is there
    std::list<uint32_t>::iterator place;  // in unpinned_, while pins == 0
  };

  void unpin(uint32_t page);
  Result<PagePin> load(uint32_t page, std::unique_lock<std::mutex>& lock);
  // These two REQUIRE the lock.
  void addPin(Entry& entry);
  bool makeRoom(uint64_t bytes);

  const PageSource& source_;
  const uint64_t budgetBytes_;
  mutable std::mutex mutex_;
  std::condition_variable loaded_;
  // Guarded by mutex_:
  std::unordered_map<uint32_t, Entry> entries_;
  std::list<uint32_t> unpinned_;  // least recently used first
  PageCacheStats stats_;
};

}  // namespace farcell
