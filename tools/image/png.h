// Pictures on disk, by libpng: it maps nothing else but zlib, so that the viewer may write pictures too.
#pragma once

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <span>
#include <vector>

#include "cache/base/result.h"

namespace farcell {

// 8 bits a channel, interleaved, row 0 at the top. channels: 1 grey, 3 RGB, 4 RGBA (not premultiplied in the file).
struct Picture {
  int width = 0;
  int height = 0;
  int channels = 3;
  std::vector<uint8_t> pixels;
};

// A premultiplied channel as such a picture has it; 0 where alpha is.
inline uint8_t withoutAlpha(uint8_t value, uint8_t alpha) {
  return alpha == 0 ? uint8_t{0} : static_cast<uint8_t>(std::min(255, (value * 255 + alpha / 2) / alpha));
}

Result<> writePng(const std::filesystem::path& path, const Picture& picture);
// As grey, RGB or RGBA of 8 bits, whatever the file holds; pictures larger than maxPixels are refused by their header.
Result<Picture> readPng(const std::filesystem::path& path, uint64_t maxPixels);

}  // namespace farcell
