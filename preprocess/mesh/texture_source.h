// What colours triangles and makes them surfaces, as a mesh file names it: an image, not yet looked at, and what the
// material that uses it says of alpha and sides.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <vector>

namespace farcell {

inline constexpr uint32_t kNoTexture = 0xffffffffu;

enum class TextureWrap : uint8_t { repeat, mirror, clamp };

// What alpha means: nothing; a hole where it is less than the cutoff; the share of what is seen that the surface makes.
enum class AlphaMode : uint8_t { opaque, mask, blend };

// Where triangles with a texture are a surface, and for whom.
struct SurfaceKind {
  bool hasImage = true;     // false: white wherever coordinates point, alpha is the opacity
  bool doubleSided = true;  // false: seen only by those for whom the corners run counter-clockwise
  AlphaMode alpha = AlphaMode::opaque;
  float cutoff = 0.5f;  // of a mask

  // Seen by everyone on every ray that meets a triangle.
  bool whole() const { return alpha == AlphaMode::opaque && doubleSided; }
  bool operator==(const SurfaceKind&) const = default;
};

// The image is PNG or JPEG: bytes [offsetBytes, offsetBytes + sizeBytes) of `file`, or `embedded`.
struct TextureSource {
  std::filesystem::path file;  // with embedded bytes: the file that holds them, for messages
  uint64_t offsetBytes = 0;
  uint64_t sizeBytes = 0;                                  // 0: to the end of the file
  std::shared_ptr<const std::vector<std::byte>> embedded;  // decoded from text (a data URI); null: see `file`
  TextureWrap wrapU = TextureWrap::repeat;
  TextureWrap wrapV = TextureWrap::repeat;
  SurfaceKind surface{};
  // Another image, of the same wraps and of any size, whose alpha - or where it has none, whose brightness - is the
  // alpha instead: what MTL calls map_d. Then an empty `file` is white. Empty: there is none.
  std::filesystem::path opacityFile{};
  float opacity = 1;  // what the image's alpha is multiplied with, in [0, 1]
};

}  // namespace farcell
