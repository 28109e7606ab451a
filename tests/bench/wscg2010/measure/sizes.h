// Bytes of a cell's images, coded in several ways.
#pragma once

#include <string>
#include <vector>

#include "tests/bench/wscg2010/measure/errors.h"

namespace farcell::wscg {

enum class Coding {
  raw,         // all texels
  cropped,     // the covered rectangle
  zlibImages,  // cropped, zlib 6, each image by itself
  zlibCell,    // cropped, zlib 6, all images of the cell as one stream: nearest to a ZIP of its file
  planes,      // cropped, coded as a pack codes colour
  webp,        // cropped, WebP lossless, method 4
  xzCell,      // cropped, xz 6, all images of the cell as one stream: a slow general coder
};
inline constexpr size_t kCodingCount = 7;
const char* codingName(Coding coding);

struct SizeSettings {
  int cells = 12;  // how many are sampled, evenly along the octree's order
};

struct SizeResult {
  std::string scene;
  std::string variant;
  size_t sampledCells = 0, occupiedCells = 0;
  size_t images = 0, emptyImages = 0;        // of the sampled cells
  double bytesPerCell[kCodingCount] = {};    // mean over the sampled cells
  double secondsPerCell[kCodingCount] = {};  // encoding, one thread
  double share(Coding coding) const;         // of the cropped bytes
  double bytes(Coding coding) const { return bytesPerCell[static_cast<size_t>(coding)]; }
};

Result<SizeResult> measureSizes(const CellIndex& index, const Variant& variant, const SizeSettings& settings);

}  // namespace farcell::wscg
