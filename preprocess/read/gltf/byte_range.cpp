#include "preprocess/read/gltf/byte_range.h"

#include <cstring>

namespace farcell {

Result<> ByteRange::read(std::span<std::byte> out) const {
  FARCELL_CHECK_EQ(out.size(), size);
  if (file) return file->readAt(offset, out);
  if (!out.empty()) std::memcpy(out.data(), memory->data() + offset, out.size());
  return {};
}

ByteRange inMemory(std::vector<std::byte> bytes) {
  const uint64_t size = bytes.size();
  return {nullptr, std::make_shared<const std::vector<std::byte>>(std::move(bytes)), 0, size};
}

}  // namespace farcell
