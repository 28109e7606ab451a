#include "preprocess/read/gltf/image_source.h"

#include "preprocess/read/gltf/uri.h"

namespace farcell {
namespace {

constexpr uint64_t kMaxDataUriBytes = uint64_t{256} << 20;  // of one image

Result<> checkKind(const GltfPlace& place, const ByteRange& image) {
  constexpr std::array<unsigned char, 4> kPng = {0x89, 'P', 'N', 'G'};
  constexpr std::array<unsigned char, 3> kJpeg = {0xff, 0xd8, 0xff};
  std::array<unsigned char, 4> start{};
  if (image.size < start.size()) return place.bad("a PNG or JPEG image", fmt::format("{} bytes", image.size));
  FARCELL_TRY(image.part(0, start.size()).read(std::as_writable_bytes(std::span(start))));
  if (start == kPng || std::equal(kJpeg.begin(), kJpeg.end(), start.begin())) return {};
  return place.failed(
      ErrorKind::unsupported, "a PNG or JPEG image",
      fmt::format("one that begins with {:02x} {:02x} {:02x} {:02x}", start[0], start[1], start[2], start[3]));
}

Result<ByteRange> bytesOf(GltfBuffers& buffers, const GltfPlace& place, const GltfImage& image) {
  if (image.view) {
    FARCELL_ASSIGN(const GltfView* view, buffers.checkedView(place.in("bufferView"), *image.view));
    if (view->coding) return place.in("bufferView").bad("a view that is not compressed", std::to_string(*image.view));
    return buffers.plainBytes(*view);
  }
  if (image.uri.empty()) return place.bad("a uri or a bufferView", "neither");
  if (isDataUri(image.uri)) {
    FARCELL_ASSIGN(MemoryClaim room, buffers.claim(place.in("uri"), image.uri.size()));
    FARCELL_ASSIGN(std::vector<std::byte> bytes, decodeDataUri(place.in("uri"), image.uri, kMaxDataUriBytes));
    return inMemory(std::move(room), std::move(bytes));
  }
  FARCELL_ASSIGN(const InputFile* file, buffers.openBeside(place.in("uri"), image.uri));
  return ByteRange{file, nullptr, 0, file->sizeBytes()};
}

}  // namespace

Result<TextureSource> imageSource(GltfBuffers& buffers, const GltfPlace& place, const GltfImage& image) {
  FARCELL_ASSIGN(const ByteRange range, bytesOf(buffers, place, image));
  FARCELL_TRY(checkKind(place, range));
  TextureSource source;
  source.file = range.file ? range.file->path() : place.path;
  source.offsetBytes = range.file ? range.offset : 0;
  source.sizeBytes = range.size;
  if (range.file) return source;
  const bool isAll = range.size == range.memory->size();
  if (!isAll) FARCELL_TRY(buffers.claimTable(place, range.size));
  const auto begin = range.memory->begin() + static_cast<std::ptrdiff_t>(range.offset);
  source.embedded =
      isAll ? range.memory
            : std::make_shared<const std::vector<std::byte>>(begin, begin + static_cast<std::ptrdiff_t>(range.size));
  return source;
}

}  // namespace farcell
