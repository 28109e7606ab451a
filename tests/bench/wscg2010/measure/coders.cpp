#include "tests/bench/wscg2010/measure/coders.h"

#include <lzma.h>
#include <webp/encode.h>
#include <zlib.h>

#include <algorithm>

#include "cache/base/check.h"
#include "cache/pack/view_planes.h"
#include "cache/pack/zlib_stream.h"

namespace farcell::wscg {
namespace {

constexpr int kPackZlibLevel = 6;

// Undoes WebP's structures however the function is left.
struct Picture {
  WebPPicture picture{};
  WebPMemoryWriter writer{};
  Picture() = default;
  Picture(const Picture&) = delete;
  Picture& operator=(const Picture&) = delete;
  ~Picture() {
    WebPPictureFree(&picture);
    WebPMemoryWriterClear(&writer);
  }
};

std::vector<std::byte> bytesOf(const uint8_t* data, size_t size) {
  const auto* first = reinterpret_cast<const std::byte*>(data);
  return {first, first + size};
}

}  // namespace

Result<std::vector<std::byte>> zlibCoded(std::span<const uint8_t> bytes, int level) {
  uLongf size = compressBound(bytes.size());
  std::vector<std::byte> coded(size);
  const int code = compress2(reinterpret_cast<Bytef*>(coded.data()), &size, bytes.data(), bytes.size(), level);
  if (code != Z_OK) return fail(ErrorKind::exhausted, "zlib failed on {} bytes: error {}", bytes.size(), code);
  coded.resize(size);
  return coded;
}

Result<std::vector<std::byte>> xzCoded(std::span<const uint8_t> bytes, uint32_t preset) {
  std::vector<std::byte> coded(lzma_stream_buffer_bound(bytes.size()));
  size_t size = 0;
  const lzma_ret code = lzma_easy_buffer_encode(preset, LZMA_CHECK_CRC32, nullptr, bytes.data(), bytes.size(),
                                                reinterpret_cast<uint8_t*>(coded.data()), &size, coded.size());
  if (code != LZMA_OK)
    return fail(ErrorKind::exhausted, "liblzma failed on {} bytes: error {}", bytes.size(), static_cast<int>(code));
  coded.resize(size);
  return coded;
}

Result<std::vector<std::byte>> webpCoded(const CellImage& image, int method) {
  WebPConfig config;
  Picture out;
  bool good = WebPConfigInit(&config) != 0 && WebPPictureInit(&out.picture) != 0;
  config.lossless = 1;
  config.exact = 1;
  config.method = method;
  WebPMemoryWriterInit(&out.writer);
  out.picture.use_argb = 1;
  out.picture.width = image.width;
  out.picture.height = image.height;
  out.picture.writer = WebPMemoryWrite;
  out.picture.custom_ptr = &out.writer;
  good = good && WebPPictureImportRGBA(&out.picture, image.rgba.data(), 4 * image.width) != 0 &&
         WebPEncode(&config, &out.picture) != 0;
  if (!good)
    return fail(ErrorKind::exhausted, "WebP failed on {} x {} texels: error {}", image.width, image.height,
                static_cast<int>(out.picture.error_code));
  return bytesOf(out.writer.mem, out.writer.size);
}

std::vector<std::byte> planesCoded(const CellImage& image) {
  FARCELL_CHECK_EQ(image.rgba.size(), size_t{4} * static_cast<size_t>(image.width * image.height));
  ViewImage view;
  view.width = static_cast<uint32_t>(image.width);
  view.height = static_cast<uint32_t>(image.height);
  view.rgba = image.rgba;
  view.depth.resize(image.rgba.size() / 4);  // a view has one; all zero, it takes next to nothing
  std::vector<std::byte> best;
  for (const Arrangement arrangement : {Arrangement::plain, Arrangement::sparse}) {
    const ArrangedView arranged = arrangedFromView(view, kPlanesWithoutNormals, arrangement, {});
    std::vector<std::byte> coded = zlibCompress(arranged.bytes, kPackZlibLevel);
    if (best.empty() || coded.size() < best.size()) best = std::move(coded);
  }
  return best;
}

}  // namespace farcell::wscg
