// Bytes that lie in a file or in memory, and walking equal elements of them without holding a file's bytes.
#pragma once

#include <algorithm>
#include <memory>
#include <vector>

#include "cache/base/check.h"
#include "cache/base/file.h"
#include "cache/base/interrupt.h"
#include "preprocess/mesh/read_memory.h"

namespace farcell {

using SharedBytes = std::shared_ptr<const std::vector<std::byte>>;

struct ByteRange {
  const InputFile* file = nullptr;  // null: in memory
  SharedBytes memory;
  uint64_t offset = 0;
  uint64_t size = 0;

  // REQUIRES: inside this one.
  ByteRange part(uint64_t from, uint64_t length) const {
    FARCELL_CHECK(from <= size && length <= size - from);
    return {file, memory, offset + from, length};
  }
  Result<> read(std::span<std::byte> out) const;  // out.size() == size
};

// The claim is held as long as the bytes.
ByteRange inMemory(MemoryClaim claim, std::vector<std::byte> bytes);

// Calls take(const std::byte*) -> bool for `count` elements of elementBytes, strideBytes apart, until it says false.
// REQUIRES: they lie within the range.
template <class Take>
Result<> forEachElement(const ByteRange& range, uint64_t count, size_t strideBytes, size_t elementBytes,
                        const Take& take) {
  constexpr size_t kChunkBytes = size_t{1} << 18;  // stays in the second-level cache
  const uint64_t perChunk = std::max<size_t>(1, kChunkBytes / strideBytes);
  std::vector<std::byte> chunk;
  for (uint64_t first = 0; first < count; first += perChunk) {
    FARCELL_TRY(checkInterrupt());
    const uint64_t here = std::min(perChunk, count - first);
    const ByteRange part = range.part(first * strideBytes, (here - 1) * strideBytes + elementBytes);
    const std::byte* at = nullptr;
    if (part.file) {
      chunk.resize(part.size);
      FARCELL_TRY(part.read(chunk));
      at = chunk.data();
    } else {
      at = part.memory->data() + part.offset;
    }
    for (uint64_t i = 0; i < here; ++i, at += strideBytes)
      if (!take(at)) return {};
  }
  return {};
}

}  // namespace farcell
