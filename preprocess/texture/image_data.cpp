#include "preprocess/texture/image_data.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <string_view>

#include "cache/base/file.h"

namespace farcell {
namespace {

constexpr std::array<uint8_t, 8> kPngMagic = {0x89, 'P', 'N', 'G', '\r', '\n', 0x1a, '\n'};
constexpr std::array<std::string_view, 5> kPngChunks = {"IHDR", "PLTE", "tRNS", "IDAT", "IEND"};
constexpr size_t kPngChunkFrame = 12;  // length, name, checksum

uint32_t bigEndian(const std::byte* bytes, size_t count) {
  uint32_t value = 0;
  for (size_t i = 0; i < count; ++i) value = value << 8 | std::to_integer<uint32_t>(bytes[i]);
  return value;
}

// Moves parts of a buffer to its front, one after the other.
class Compaction {
 public:
  explicit Compaction(std::vector<std::byte>& bytes) : bytes_(bytes) {}
  void keep(size_t begin, size_t end) {
    std::memmove(bytes_.data() + kept_, bytes_.data() + begin, end - begin);
    kept_ += end - begin;
  }
  void finish() { bytes_.resize(kept_); }

 private:
  std::vector<std::byte>& bytes_;
  size_t kept_ = 0;
};

Result<> setSize(ImageData& image, uint32_t width, uint32_t height, bool wholeAtOnce, const std::string& name) {
  if (width == 0 || height == 0) return fail(ErrorKind::corrupt, "{}: an image of {} x {} pixels", name, width, height);
  const uint64_t maxPixels = wholeAtOnce ? kMaxWholeImagePixels : kMaxImagePixels;
  if (std::max(width, height) > kMaxImageEdge || uint64_t{width} * height > maxPixels)
    return fail(ErrorKind::exhausted, "{}: {} x {} pixels, at most {} are allowed and {} along an edge", name, width,
                height, maxPixels, kMaxImageEdge);
  image.width = static_cast<int>(width);
  image.height = static_cast<int>(height);
  return {};
}

tl::unexpected<Error> cutOff(const std::string& name, size_t size) {
  return corrupt(name, size, "the rest of the image", "its end");
}

// Portable Network Graphics (PNG) Specification, 2nd edition, 2003, sections 5 and 11.2.
Result<> scanPng(ImageData& image, const std::string& name) {
  constexpr size_t kHeaderBytes = 13;
  std::vector<std::byte>& bytes = image.bytes;
  Compaction compaction(bytes);
  size_t at = kPngMagic.size();
  compaction.keep(0, at);
  for (bool first = true, last = false; !last; first = false) {
    if (bytes.size() - at < kPngChunkFrame) return cutOff(name, bytes.size());
    const size_t length = bigEndian(bytes.data() + at, 4);
    if (bytes.size() - at - kPngChunkFrame < length) return cutOff(name, bytes.size());
    const std::string_view chunk(reinterpret_cast<const char*>(bytes.data() + at + 4), 4);
    if (first) {
      if (chunk != "IHDR" || length != kHeaderBytes) return corrupt(name, at, "an IHDR chunk", "another one");
      const std::byte* header = bytes.data() + at + 8;
      FARCELL_TRY(setSize(image, bigEndian(header, 4), bigEndian(header + 4, 4), header[12] != std::byte{0}, name));
    }
    last = chunk == "IEND";
    const bool keep = std::find(kPngChunks.begin(), kPngChunks.end(), chunk) != kPngChunks.end();
    if (keep) compaction.keep(at, at + kPngChunkFrame + length);
    at += kPngChunkFrame + length;
  }
  compaction.finish();
  return {};
}

bool isFrameHeader(uint32_t marker) {
  return marker >= 0xc0 && marker <= 0xcf && marker != 0xc4 && marker != 0xc8 && marker != 0xcc;
}
// APP0 (JFIF) and APP14 (Adobe) say what the channels are.
bool isPassedOver(uint32_t marker) { return (marker > 0xe0 && marker <= 0xef && marker != 0xee) || marker == 0xfe; }

// ITU-T T.81 (JPEG), 1992, annex B.
Result<> scanJpeg(ImageData& image, const std::string& name) {
  constexpr std::array<std::byte, 2> kEndOfImage = {std::byte{0xff}, std::byte{0xd9}};
  std::vector<std::byte>& bytes = image.bytes;
  Compaction compaction(bytes);
  size_t at = 2;
  compaction.keep(0, at);
  for (uint32_t marker = 0; marker != 0xda;) {
    while (at + 1 < bytes.size() && bytes[at] == std::byte{0xff} && bytes[at + 1] == std::byte{0xff}) ++at;  // filling
    if (bytes.size() - at < 4) return cutOff(name, bytes.size());
    if (bytes[at] != std::byte{0xff}) return corrupt(name, at, "a marker", "something else");
    marker = std::to_integer<uint32_t>(bytes[at + 1]);
    const size_t length = bigEndian(bytes.data() + at + 2, 2);
    if (length < 2) return corrupt(name, at, "the length of a segment", "less than 2");
    if (bytes.size() - at - 2 < length) return cutOff(name, bytes.size());
    if (isFrameHeader(marker)) {
      if (length < 8) return corrupt(name, at, "a frame header", "a shorter one");
      const std::byte* size = bytes.data() + at + 5;
      const bool sequential = marker == 0xc0 || marker == 0xc1;
      FARCELL_TRY(setSize(image, bigEndian(size + 2, 2), bigEndian(size, 2), !sequential, name));
    }
    const size_t next = at + 2 + length;
    if (!isPassedOver(marker)) compaction.keep(at, next);
    at = next;
  }
  if (image.width == 0) return corrupt(name, at, "a frame header before the scan", "none");
  // No coded data looks like it; readers would fill what is missing with grey.
  if (std::search(bytes.begin() + static_cast<ptrdiff_t>(at), bytes.end(), kEndOfImage.begin(), kEndOfImage.end()) ==
      bytes.end())
    return cutOff(name, bytes.size());
  compaction.keep(at, bytes.size());
  compaction.finish();
  return {};
}

bool startsWith(const std::vector<std::byte>& bytes, std::span<const uint8_t> magic) {
  return bytes.size() >= magic.size() && std::memcmp(bytes.data(), magic.data(), magic.size()) == 0;
}

Result<std::vector<std::byte>> storedBytes(const TextureSource& source) {
  if (source.embedded) return *source.embedded;
  FARCELL_ASSIGN(const InputFile file, InputFile::open(source.file));
  if (source.offsetBytes > file.sizeBytes() || source.sizeBytes > file.sizeBytes() - source.offsetBytes)
    return corrupt(file.path(), source.offsetBytes, fmt::format("an image of {} bytes", source.sizeBytes),
                   fmt::format("a file of {} bytes", file.sizeBytes()));
  const uint64_t size = source.sizeBytes > 0 ? source.sizeBytes : file.sizeBytes() - source.offsetBytes;
  if (size > kMaxImageBytes)
    return fail(ErrorKind::exhausted, "{}: an image of {} bytes, at most {} are allowed", file.path(), size,
                kMaxImageBytes);
  std::vector<std::byte> bytes(size);
  FARCELL_TRY(file.readAt(source.offsetBytes, bytes));
  return bytes;
}

}  // namespace

Result<ImageData> imageData(std::vector<std::byte> bytes, const std::string& name) {
  constexpr std::array<uint8_t, 3> kJpegMagic = {0xff, 0xd8, 0xff};
  ImageData image{ImageFormat::png, 0, 0, std::move(bytes)};
  if (startsWith(image.bytes, kPngMagic)) {
    FARCELL_TRY(scanPng(image, name));
  } else if (startsWith(image.bytes, kJpegMagic)) {
    image.format = ImageFormat::jpeg;
    FARCELL_TRY(scanJpeg(image, name));
  } else {
    return fail(ErrorKind::corrupt, "{}: expected a PNG or JPEG image, found neither's first bytes", name);
  }
  return image;
}

Result<ImageData> readImageData(const TextureSource& source) {
  FARCELL_ASSIGN(std::vector<std::byte> bytes, storedBytes(source));
  const bool inside = source.embedded || source.offsetBytes > 0 || source.sizeBytes > 0;
  return imageData(
      std::move(bytes),
      inside ? fmt::format("{} (image at offset {})", source.file.string(), source.offsetBytes) : source.file.string());
}

}  // namespace farcell
