// Pictures like the paper's figures 4, 7 to 17.
#pragma once

#include <filesystem>
#include <string>

#include "tests/bench/wscg2010/measure/errors.h"

namespace farcell::wscg {

// Each picture is kPictureWidth x kPictureHeight; the contact sheet shows them at a third of that, kSheetColumns a row.
inline constexpr int kPictureWidth = 960;
inline constexpr int kPictureHeight = 720;
inline constexpr int kSheetColumns = 4;

// Figure 15 in numbers: cells whose centre is nearer than a threshold drawn as triangles, all others as impostors.
struct NearTriangles {
  std::string scene;
  double threshold = 0;  // of the scene's radius
  size_t cellsAsTriangles = 0, cells = 0;
  double errorWithout = 0, errorWith = 0;  // paperError against the triangles at one sample a pixel
};

// Writes figure-NN-*.png and sheet.png into `directory`. `index` has the paper's depth. REQUIRES: a current context.
Result<NearTriangles> drawPictures(const CellIndex& index, const FullGeometry& full,
                                   const std::filesystem::path& directory);

}  // namespace farcell::wscg
