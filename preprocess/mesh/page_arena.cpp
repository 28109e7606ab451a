#include "preprocess/mesh/page_arena.h"

#include <sys/mman.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <utility>

#include "cache/base/check.h"

namespace farcell {
namespace {
constexpr uint64_t kLargePageBytes = uint64_t{2} << 20;
constexpr uint64_t kLeastForLargePages = 16 * kLargePageBytes;  // else they would be too much of it
}  // namespace

PageArena::PageArena(std::byte* region, uint64_t regionBytes, uint64_t pageBytes)
    : region_(region), regionBytes_(regionBytes), pageBytes_(pageBytes) {}

PageArena::PageArena(PageArena&& other) noexcept
    : region_(std::exchange(other.region_, nullptr)),
      regionBytes_(std::exchange(other.regionBytes_, 0)),
      pageBytes_(other.pageBytes_),
      untouched_(other.untouched_),
      warm_(std::move(other.warm_)),
      cold_(std::move(other.cold_)) {}

PageArena& PageArena::operator=(PageArena&& other) noexcept {
  std::swap(region_, other.region_);
  std::swap(regionBytes_, other.regionBytes_);
  std::swap(pageBytes_, other.pageBytes_);
  std::swap(untouched_, other.untouched_);
  std::swap(warm_, other.warm_);
  std::swap(cold_, other.cold_);
  return *this;
}

PageArena::~PageArena() {
  if (region_ != nullptr) ::munmap(region_, regionBytes_);
}

Result<PageArena> PageArena::create(uint64_t maxBytes, uint64_t pageBytes) {
  const uint64_t size = (maxBytes + pageBytes - 1) / pageBytes * pageBytes;
  void* region = ::mmap(nullptr, size, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
  if (region == MAP_FAILED)
    return fail(ErrorKind::exhausted, "expected {} bytes of address space to read meshes in: {}", size,
                std::strerror(errno));
  if (size >= kLeastForLargePages) ::madvise(region, size, MADV_HUGEPAGE);  // a wish: without them it is slower
  return PageArena(static_cast<std::byte*>(region), size, pageBytes);
}

std::byte* PageArena::take() {
  for (std::vector<std::byte*>* given : {&warm_, &cold_}) {
    if (given->empty()) continue;
    std::byte* page = given->back();
    given->pop_back();
    return page;
  }
  FARCELL_CHECK(untouched_ < regionBytes_);
  return region_ + std::exchange(untouched_, untouched_ + pageBytes_);
}

void PageArena::trim() {
  // Smaller ones than the system's, of a tiny memory, stay.
  const auto systemPage = static_cast<uint64_t>(::sysconf(_SC_PAGESIZE));
  if (pageBytes_ >= systemPage)
    for (std::byte* page : warm_) ::madvise(page, pageBytes_, MADV_DONTNEED);
  cold_.insert(cold_.end(), warm_.begin(), warm_.end());
  warm_.clear();
}

}  // namespace farcell
