#include "tests/bench/codec/coders.h"

#include <webp/decode.h>
#include <webp/encode.h>
#include <zstd.h>

#include <cstring>
#include <string_view>

#include "cache/base/check.h"
#include "cache/pack/encoded_view.h"
#include "cache/pack/zlib_stream.h"
#include "tests/bench/thread_seconds.h"

namespace farcell {
namespace {

using Bytes = std::vector<std::byte>;

Bytes texelsOf(const ViewImage& view) {
  Bytes texels;
  for (const auto* plane : {&view.rgba, &view.depth, &view.normal}) {
    const auto bytes = std::as_bytes(std::span(*plane));
    texels.insert(texels.end(), bytes.begin(), bytes.end());
  }
  return texels;
}

Bytes planesOf(const ViewImage& view, size_t rawBytes) {
  Bytes planes(rawBytes + 2);
  const Result<size_t> size = zlibDecompressUpTo(encodeView(view).stream, planes);
  FARCELL_CHECK(size.has_value());
  planes.resize(*size);
  return planes;
}

Bytes zstdCompressed(std::span<const std::byte> raw, int level) {
  Bytes stream(ZSTD_compressBound(raw.size()));
  const size_t size = ZSTD_compress(stream.data(), stream.size(), raw.data(), raw.size(), level);
  FARCELL_CHECK(!ZSTD_isError(size));
  stream.resize(size);
  return stream;
}

// Lossless; `level` is webp's method, 0 (fast) to 6.
Bytes webpCompressed(std::span<const uint8_t> rgba, const ViewImage& view, int level) {
  WebPConfig config;
  WebPPicture picture;
  FARCELL_CHECK(WebPConfigInit(&config) && WebPPictureInit(&picture));
  config.lossless = config.exact = 1;
  config.method = level;
  config.quality = 75;
  picture.use_argb = 1;
  picture.width = static_cast<int>(view.width);
  picture.height = static_cast<int>(view.height);
  WebPMemoryWriter writer;
  WebPMemoryWriterInit(&writer);
  picture.writer = WebPMemoryWrite;
  picture.custom_ptr = &writer;
  FARCELL_CHECK(WebPPictureImportRGBA(&picture, rgba.data(), 4 * picture.width));
  FARCELL_CHECK(WebPEncode(&config, &picture));
  const auto* bytes = reinterpret_cast<const std::byte*>(writer.mem);
  Bytes stream(bytes, bytes + writer.size);
  WebPPictureFree(&picture);
  WebPMemoryWriterClear(&writer);
  return stream;
}

void webpDecompress(const Bytes& stream) {
  int width = 0, height = 0;
  uint8_t* const rgba = WebPDecodeRGBA(reinterpret_cast<const uint8_t*>(stream.data()), stream.size(), &width, &height);
  FARCELL_CHECK(rgba != nullptr);
  WebPFree(rgba);
}

// Depth as the green of a picture of its own, as webp keeps grey pictures small.
std::vector<uint8_t> depthPicture(const ViewImage& view) {
  std::vector<uint8_t> rgba;
  for (const uint8_t depth : view.depth) rgba.insert(rgba.end(), {0, depth, 0, 255});
  return rgba;
}

// `encode` gives streams, `decode` reads one.
template <class Encode, class Decode>
void measure(CoderTotals& totals, const Encode& encode, const Decode& decode) {
  const double start = threadSeconds();
  const std::vector<Bytes> streams = encode();
  const double encoded = threadSeconds();
  for (const Bytes& stream : streams) decode(stream);
  totals.decodeSeconds += threadSeconds() - encoded;
  totals.encodeSeconds += encoded - start;
  for (const Bytes& stream : streams) totals.storedBytes += stream.size();
}

void addWebp(const ViewImage& view, CoderTotals& totals) {
  const std::vector<uint8_t> depth = depthPicture(view);
  const auto encode = [&] {
    return std::vector<Bytes>{webpCompressed(view.rgba, view, totals.level), webpCompressed(depth, view, totals.level)};
  };
  measure(totals, encode, webpDecompress);
}

void addBytes(const Bytes& raw, CoderTotals& totals) {
  Bytes decoded(raw.size());
  if (totals.name == std::string_view("zstd"))
    measure(
        totals, [&] { return std::vector<Bytes>{zstdCompressed(raw, totals.level)}; },
        [&](const Bytes& stream) { ZSTD_decompress(decoded.data(), decoded.size(), stream.data(), stream.size()); });
  else
    measure(
        totals, [&] { return std::vector<Bytes>{zlibCompress(raw, totals.level)}; },
        [&](const Bytes& stream) { FARCELL_CHECK(zlibDecompress(stream, decoded).has_value()); });
  FARCELL_CHECK(decoded == raw);
}

}  // namespace

std::vector<CoderTotals> otherCoders() {
  std::vector<CoderTotals> coders;
  for (const int level : {5, 1, 3, 4, 6, 9, 12}) coders.push_back({"deflate", "planes", level});
  for (const int level : {1, 3, 9, 19}) coders.push_back({"zstd", "planes", level});
  for (const int level : {6, 12}) coders.push_back({"deflate", "texels", level});
  for (const int level : {3, 19}) coders.push_back({"zstd", "texels", level});
  for (const int level : {0, 4}) coders.push_back({"webp", "texels", level});
  return coders;
}

void addView(const ViewImage& view, std::vector<CoderTotals>& totals) {
  const Bytes texels = texelsOf(view);
  const Bytes planes = planesOf(view, texels.size());
  for (CoderTotals& coder : totals) {
    coder.rawBytes += texels.size();
    if (coder.name == std::string_view("webp"))
      addWebp(view, coder);
    else
      addBytes(coder.input == std::string_view("planes") ? planes : texels, coder);
  }
}

}  // namespace farcell
