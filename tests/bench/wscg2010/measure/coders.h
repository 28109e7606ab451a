// Ways of storing images, from the paper's and from now.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "cache/base/result.h"
#include "tests/bench/wscg2010/scene/image_baker.h"

namespace farcell::wscg {

// zlib's own deflate, a stream of its own.
Result<std::vector<std::byte>> zlibCoded(std::span<const uint8_t> bytes, int level);
// The LZMA2 of xz, in its container.
Result<std::vector<std::byte>> xzCoded(std::span<const uint8_t> bytes, uint32_t preset);
// WebP, lossless, also of what full transparency hides. method: 0 (fast) to 6 (small). REQUIRES: width > 0.
Result<std::vector<std::byte>> webpCoded(const CellImage& image, int method);
// The colour planes of a pack's view (view_planes.h): the smaller of both arrangements, deflated as packs are. A pack
// stores a fifth plane, depth, which the paper's images lack.
std::vector<std::byte> planesCoded(const CellImage& image);

}  // namespace farcell::wscg
