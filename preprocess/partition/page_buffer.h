// Memory by whole pages, straight from the system: what is never touched costs nothing, and what is released is gone.
// The heap keeps freed blocks, for each thread its own, and a ceiling cannot be kept with what it holds unseen.
#pragma once

#include <cstddef>

#include "cache/base/result.h"

namespace farcell {

class PageBuffer {
 public:
  static Result<PageBuffer> create(size_t sizeBytes);
  PageBuffer() = default;
  PageBuffer(PageBuffer&& other) noexcept;
  PageBuffer& operator=(PageBuffer&& other) noexcept;
  PageBuffer(const PageBuffer&) = delete;
  PageBuffer& operator=(const PageBuffer&) = delete;
  ~PageBuffer();

  std::byte* data() const { return data_; }  // zero at first
  size_t sizeBytes() const { return sizeBytes_; }

 private:
  PageBuffer(std::byte* data, size_t sizeBytes) : data_(data), sizeBytes_(sizeBytes) {}
  std::byte* data_ = nullptr;
  size_t sizeBytes_ = 0;
};

}  // namespace farcell
