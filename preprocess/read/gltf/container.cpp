#include "preprocess/read/gltf/container.h"

#include <array>
#include <bit>

namespace farcell {
namespace {

constexpr uint32_t kMagic = 0x46546C67;        // "glTF"
constexpr uint32_t kJsonChunk = 0x4E4F534A;    // "JSON"
constexpr uint32_t kBinaryChunk = 0x004E4942;  // "BIN\0"
constexpr uint64_t kHeaderBytes = 12;
constexpr uint64_t kChunkHeaderBytes = 8;
constexpr uint64_t kMaxJsonBytes = uint64_t{512} << 20;  // with buffers as data URIs in it

template <size_t kCount>
Result<std::array<uint32_t, kCount>> readWords(const InputFile& file, uint64_t offset) {
  static_assert(std::endian::native == std::endian::little);
  std::array<uint32_t, kCount> words{};
  FARCELL_TRY(file.readAt(offset, std::as_writable_bytes(std::span(words))));
  return words;
}

Result<std::string> readJson(const InputFile& file, uint64_t offset, uint64_t size) {
  if (size > kMaxJsonBytes)
    return fail(ErrorKind::exhausted, "{}: offset {}: expected at most {} bytes of JSON, found {}", file.path(), offset,
                kMaxJsonBytes, size);
  std::string text(size, '\0');
  FARCELL_TRY(file.readAt(offset, std::as_writable_bytes(std::span(text))));
  return text;
}

struct Chunk {
  uint32_t type = 0;
  uint64_t offset = 0;  // of its bytes
  uint64_t size = 0;
};

Result<Chunk> readChunk(const InputFile& file, uint64_t offset) {
  const uint64_t left = file.sizeBytes() - offset;
  if (left < kChunkHeaderBytes)
    return corrupt(file.path(), offset, "a chunk's length and type (8 bytes)", fmt::format("{} bytes", left));
  FARCELL_ASSIGN(const auto words, readWords<2>(file, offset));
  if (words[0] > left - kChunkHeaderBytes)
    return corrupt(file.path(), offset, fmt::format("a chunk of at most {} bytes", left - kChunkHeaderBytes),
                   fmt::format("a length of {}", words[0]));
  return Chunk{words[1], offset + kChunkHeaderBytes, words[0]};
}

Result<> checkHeader(const InputFile& file) {
  if (file.sizeBytes() < kHeaderBytes)
    return corrupt(file.path(), 0, "the header of a binary glTF file (12 bytes)",
                   fmt::format("{} bytes", file.sizeBytes()));
  FARCELL_ASSIGN(const auto words, readWords<3>(file, 0));
  if (words[1] != 2)
    return fail(ErrorKind::unsupported, "{}: offset 4: expected version 2 of binary glTF, found {}", file.path(),
                words[1]);
  if (words[2] != file.sizeBytes())
    return corrupt(file.path(), 8, fmt::format("the length of the file, {}", file.sizeBytes()),
                   fmt::format("{}", words[2]));
  return {};
}

}  // namespace

bool startsLikeGlb(const InputFile& file) {
  if (file.sizeBytes() < sizeof(kMagic)) return false;
  const auto words = readWords<1>(file, 0);
  return words && (*words)[0] == kMagic;
}

Result<GltfContainer> readContainer(const InputFile& file) {
  GltfContainer container;
  if (!startsLikeGlb(file)) {
    FARCELL_ASSIGN(container.json, readJson(file, 0, file.sizeBytes()));
    return container;
  }
  FARCELL_TRY(checkHeader(file));
  FARCELL_ASSIGN(const Chunk json, readChunk(file, kHeaderBytes));
  if (json.type != kJsonChunk)
    return corrupt(file.path(), kHeaderBytes + 4, "a chunk of type JSON first", fmt::format("{:#010x}", json.type));
  container.jsonOffset = json.offset;
  FARCELL_ASSIGN(container.json, readJson(file, json.offset, json.size));
  // Chunks of other types may follow the binary one and mean nothing to us; their lengths must add up all the same.
  for (uint64_t offset = json.offset + json.size; offset < file.sizeBytes();) {
    const bool isSecond = offset == json.offset + json.size;
    FARCELL_ASSIGN(const Chunk chunk, readChunk(file, offset));
    if (isSecond && chunk.type == kBinaryChunk) container.binary = ByteRange{&file, nullptr, chunk.offset, chunk.size};
    offset = chunk.offset + chunk.size;
  }
  return container;
}

}  // namespace farcell
