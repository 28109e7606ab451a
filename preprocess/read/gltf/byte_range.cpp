#include "preprocess/read/gltf/byte_range.h"

#include <cstring>

namespace farcell {

Result<> ByteRange::read(std::span<std::byte> out) const {
  FARCELL_CHECK_EQ(out.size(), size);
  if (file) return file->readAt(offset, out);
  if (!out.empty()) std::memcpy(out.data(), memory->data() + offset, out.size());
  return {};
}

ByteRange inMemory(MemoryClaim claim, std::vector<std::byte> bytes) {
  struct Claimed {
    MemoryClaim claim;
    std::vector<std::byte> bytes;
  };
  const uint64_t size = bytes.size();
  const auto claimed = std::make_shared<const Claimed>(Claimed{std::move(claim), std::move(bytes)});
  return {nullptr, SharedBytes(claimed, &claimed->bytes), 0, size};
}

}  // namespace farcell
