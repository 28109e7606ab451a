// An image that colours triangles, as a mesh file names it: where its bytes lie, not yet looked at.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <vector>

namespace farcell {

inline constexpr uint32_t kNoTexture = 0xffffffffu;

enum class TextureWrap : uint8_t { repeat, mirror, clamp };

// The image is PNG or JPEG: bytes [offsetBytes, offsetBytes + sizeBytes) of `file`, or `embedded`.
struct TextureSource {
  std::filesystem::path file;  // with embedded bytes: the file that holds them, for messages
  uint64_t offsetBytes = 0;
  uint64_t sizeBytes = 0;                                  // 0: to the end of the file
  std::shared_ptr<const std::vector<std::byte>> embedded;  // decoded from text (a data URI); null: see `file`
  TextureWrap wrapU = TextureWrap::repeat;
  TextureWrap wrapV = TextureWrap::repeat;
};

}  // namespace farcell
