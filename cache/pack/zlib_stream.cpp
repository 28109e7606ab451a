#include "cache/pack/zlib_stream.h"

#include <libdeflate.h>

#include <array>
#include <memory>

#include "cache/base/check.h"

namespace farcell {
namespace {

struct FreeCompressor {
  void operator()(libdeflate_compressor* c) const { libdeflate_free_compressor(c); }
};
struct FreeDecompressor {
  void operator()(libdeflate_decompressor* d) const { libdeflate_free_decompressor(d); }
};

// A compressor's tables are large: each thread keeps its own.
libdeflate_compressor* compressorOf(int level) {
  FARCELL_CHECK(level >= 1 && level <= kSlowestZlibLevel);
  thread_local std::array<std::unique_ptr<libdeflate_compressor, FreeCompressor>, kSlowestZlibLevel + 1> compressors;
  auto& compressor = compressors[static_cast<size_t>(level)];
  if (!compressor) compressor.reset(libdeflate_alloc_compressor(level));
  FARCELL_CHECK(compressor != nullptr);
  return compressor.get();
}

libdeflate_decompressor* decompressor() {
  thread_local std::unique_ptr<libdeflate_decompressor, FreeDecompressor> kept(libdeflate_alloc_decompressor());
  FARCELL_CHECK(kept != nullptr);
  return kept.get();
}

}  // namespace

std::vector<std::byte> zlibCompress(std::span<const std::byte> raw, int level) {
  libdeflate_compressor* compressor = compressorOf(level);
  std::vector<std::byte> stream(libdeflate_zlib_compress_bound(compressor, raw.size()));
  const size_t size = libdeflate_zlib_compress(compressor, raw.data(), raw.size(), stream.data(), stream.size());
  FARCELL_CHECK(size > 0);
  stream.resize(size);
  return stream;
}

Result<size_t> zlibDecompressUpTo(std::span<const std::byte> stream, std::span<std::byte> raw) {
  size_t streamUsed = 0;
  size_t rawFilled = 0;
  const libdeflate_result result = libdeflate_zlib_decompress_ex(decompressor(), stream.data(), stream.size(),
                                                                 raw.data(), raw.size(), &streamUsed, &rawFilled);
  if (result != LIBDEFLATE_SUCCESS)
    return fail(ErrorKind::corrupt, "expected a zlib stream of at most {} bytes, found {}", raw.size(),
                result == LIBDEFLATE_INSUFFICIENT_SPACE ? "a longer one" : "a damaged one");
  if (streamUsed != stream.size())
    return fail(ErrorKind::corrupt, "expected a zlib stream stored in {} bytes, found one of {}", stream.size(),
                streamUsed);
  return rawFilled;
}

Result<> zlibDecompress(std::span<const std::byte> stream, std::span<std::byte> raw) {
  FARCELL_ASSIGN(const size_t filled, zlibDecompressUpTo(stream, raw));
  if (filled != raw.size())
    return fail(ErrorKind::corrupt, "expected a zlib stream of {} bytes, found one of {}", raw.size(), filled);
  return {};
}

}  // namespace farcell
