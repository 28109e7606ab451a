#include "preprocess/partition/page_buffer.h"

#include <sys/mman.h>

#include <utility>

namespace farcell {

Result<PageBuffer> PageBuffer::create(size_t sizeBytes) {
  void* data = ::mmap(nullptr, sizeBytes, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
  if (data == MAP_FAILED) return fail(ErrorKind::exhausted, "memory: expected {} bytes, found less", sizeBytes);
  return PageBuffer(static_cast<std::byte*>(data), sizeBytes);
}

PageBuffer::PageBuffer(PageBuffer&& other) noexcept
    : data_(std::exchange(other.data_, nullptr)), sizeBytes_(std::exchange(other.sizeBytes_, 0)) {}

PageBuffer& PageBuffer::operator=(PageBuffer&& other) noexcept {
  std::swap(data_, other.data_);
  std::swap(sizeBytes_, other.sizeBytes_);
  return *this;
}

PageBuffer::~PageBuffer() {
  if (data_ != nullptr) ::munmap(data_, sizeBytes_);
}

}  // namespace farcell
