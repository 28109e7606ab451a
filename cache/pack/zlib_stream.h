// zlib streams (RFC 1950) through libdeflate: any zlib decoder reads them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "cache/base/result.h"

namespace farcell {

// No deflate stream holds more than this many times its own size.
inline constexpr uint64_t kMaxZlibRatio = 1032;

// level: 1 (fast) to 12 (small), as in libdeflate.
inline constexpr int kSlowestZlibLevel = 12;
std::vector<std::byte> zlibCompress(std::span<const std::byte> raw, int level);

// Fills `raw` exactly from the whole of `stream`; corrupt when the stream is damaged, shorter or longer.
Result<> zlibDecompress(std::span<const std::byte> stream, std::span<std::byte> raw);
// The same for a stream that may be shorter than `raw`: how many bytes it held.
Result<size_t> zlibDecompressUpTo(std::span<const std::byte> stream, std::span<std::byte> raw);

}  // namespace farcell
