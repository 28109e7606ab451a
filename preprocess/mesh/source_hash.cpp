#include "preprocess/mesh/source_hash.h"

#include <bit>

#include "cache/base/file.h"
#include "cache/base/hash.h"
#include "cache/base/interrupt.h"

namespace farcell {
namespace {

Result<uint64_t> hashFile(const std::filesystem::path& path) {
  FARCELL_ASSIGN(const InputFile file, InputFile::open(path));
  Hasher hasher;
  std::vector<std::byte> buffer(size_t{1} << 20);
  for (uint64_t offset = 0; offset < file.sizeBytes(); offset += buffer.size()) {
    FARCELL_TRY(checkInterrupt());
    const auto part = std::span(buffer).first(std::min<uint64_t>(buffer.size(), file.sizeBytes() - offset));
    FARCELL_TRY(file.readAt(offset, part));
    hasher.add(part);
  }
  return hasher.value();
}

}  // namespace

Result<uint64_t> sourceHash(const MeshReader& mesh) {
  static_assert(std::endian::native == std::endian::little);
  std::vector<uint64_t> hashes;
  for (const std::filesystem::path& path : mesh.files()) {
    FARCELL_ASSIGN(hashes.emplace_back(), hashFile(path));
  }
  return hashes.size() == 1 ? hashes[0] : hashBytes(std::as_bytes(std::span(hashes)));
}

}  // namespace farcell
