// The bytes of an image, checked before any library sees them.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "cache/base/result.h"
#include "preprocess/mesh/texture_source.h"

namespace farcell {

enum class ImageFormat { png, jpeg };

inline constexpr int kMaxImageEdge = 1 << 15;
inline constexpr uint64_t kMaxImagePixels = uint64_t{1} << 28;
// Interlaced PNG and progressive JPEG are decoded in memory as a whole, others a few rows at a time.
inline constexpr uint64_t kMaxWholeImagePixels = uint64_t{1} << 26;
inline constexpr uint64_t kMaxImageBytes = uint64_t{1} << 29;  // as stored

struct ImageData {
  ImageFormat format;
  int width = 0;
  int height = 0;
  std::vector<std::byte> bytes;
};

// Told by its first bytes, whatever its name. Keeps what pixels are made of: text, profiles and camera data, in which
// parsers have most of their faults, are cut out. `name` is for messages. corrupt: neither PNG nor JPEG, cut off, or no
// size; exhausted: beyond the limits above.
Result<ImageData> imageData(std::vector<std::byte> bytes, const std::string& name);

// The image that a mesh names.
Result<ImageData> readImageData(const TextureSource& source);

}  // namespace farcell
