#include "cache/store/page_cache.h"

#include <algorithm>
#include <new>
#include <utility>

#include "cache/base/check.h"

namespace farcell {
namespace {

Result<DecodedPage> loadPage(const PageSource& source, uint32_t page) {
  try {
    return source.load(page);
  } catch (const std::bad_alloc&) {
    return fail(ErrorKind::exhausted, "page {}: out of memory for {} decoded bytes", page, source.decodedBytes(page));
  }
}

}  // namespace

uint32_t PackPageSource::pageCount() const { return static_cast<uint32_t>(pack_.directory().pages.size()); }
uint64_t PackPageSource::decodedBytes(uint32_t page) const { return pack_.directory().pages[page].decodedBytes; }
uint64_t PackPageSource::storedBytes(uint32_t page) const { return pack_.directory().pages[page].storedBytes; }

Result<DecodedPage> PackPageSource::load(uint32_t page) const {
  const auto toPage = [](auto&& decoded) { return DecodedPage(std::forward<decltype(decoded)>(decoded)); };
  switch (pack_.directory().pages[page].kind) {
    case PageKind::geometry:
      return pack_.readGeometry(page).map(toPage);
    case PageKind::views:
      return pack_.readViews(page).map(toPage);
    case PageKind::texture:
      break;
  }
  return pack_.readTexture(page).map(toPage);
}

PagePin::PagePin(PagePin&& other) noexcept
    : cache_(std::exchange(other.cache_, nullptr)), index_(other.index_), page_(std::exchange(other.page_, nullptr)) {}

PagePin& PagePin::operator=(PagePin&& other) noexcept {
  PagePin taken(std::move(other));
  std::swap(cache_, taken.cache_);
  std::swap(index_, taken.index_);
  std::swap(page_, taken.page_);
  return *this;
}

PagePin::~PagePin() {
  if (cache_ != nullptr) cache_->unpin(index_);
}

PageCache::PageCache(const PageSource& source, uint64_t budgetBytes) : source_(source), budgetBytes_(budgetBytes) {}

PageCache::~PageCache() { FARCELL_CHECK_EQ(stats_.pinnedBytes, uint64_t{0}); }

Result<PagePin> PageCache::pin(uint32_t page) {
  FARCELL_CHECK(page < source_.pageCount());
  std::unique_lock lock(mutex_);
  const auto found = entries_.find(page);
  if (found == entries_.end()) return load(page, lock);
  Entry& entry = found->second;
  addPin(entry);
  if (const std::shared_ptr<Load> loading = entry.load; loading != nullptr) {
    loaded_.wait(lock, [&] { return loading->done; });
    if (loading->error) return tl::unexpected<Error>(*loading->error);
  }
  ++stats_.hits;
  return PagePin(this, page, &entry.page);
}

Result<PagePin> PageCache::load(uint32_t page, std::unique_lock<std::mutex>& lock) {
  const uint64_t bytes = source_.decodedBytes(page);
  if (!makeRoom(bytes)) {
    ++stats_.refused;
    return fail(ErrorKind::exhausted, "page {}: expected at most {} bytes beside {} pinned ones, found {}", page,
                budgetBytes_ - stats_.pinnedBytes, stats_.pinnedBytes, bytes);
  }
  ++stats_.misses;
  const auto loading = std::make_shared<Load>();
  Entry& entry = entries_[page];
  entry.bytes = bytes;
  entry.pins = 1;
  entry.load = loading;
  stats_.pinnedBytes += bytes;
  stats_.residentBytes += bytes;
  stats_.maximumBytes = std::max(stats_.maximumBytes, stats_.residentBytes);

  lock.unlock();
  Result<DecodedPage> decoded = loadPage(source_, page);
  lock.lock();

  loading->done = true;
  loaded_.notify_all();
  if (!decoded) {
    ++stats_.failures;
    stats_.pinnedBytes -= bytes;
    stats_.residentBytes -= bytes;
    loading->error = decoded.error();
    entries_.erase(page);
    return tl::unexpected<Error>(std::move(decoded).error());
  }
  stats_.bytesRead += source_.storedBytes(page);
  entry.page = std::move(*decoded);
  entry.load = nullptr;
  return PagePin(this, page, &entry.page);
}

void PageCache::addPin(Entry& entry) {
  if (entry.pins++ > 0) return;
  unpinned_.erase(entry.place);
  stats_.pinnedBytes += entry.bytes;
}

void PageCache::unpin(uint32_t page) {
  const std::lock_guard lock(mutex_);
  Entry& entry = entries_.at(page);
  if (--entry.pins > 0) return;
  entry.place = unpinned_.insert(unpinned_.end(), page);
  stats_.pinnedBytes -= entry.bytes;
}

bool PageCache::makeRoom(uint64_t bytes) {
  if (bytes > budgetBytes_ - stats_.pinnedBytes) return false;
  while (stats_.residentBytes + bytes > budgetBytes_) {
    const auto oldest = entries_.find(unpinned_.front());
    stats_.residentBytes -= oldest->second.bytes;
    entries_.erase(oldest);
    unpinned_.pop_front();
    ++stats_.evictions;
  }
  return true;
}

PageCacheStats PageCache::stats() const {
  const std::lock_guard lock(mutex_);
  return stats_;
}

}  // namespace farcell
