// The pictures of a report, all over the background: <stem>.reference.png, <stem>.<renderer>.png,
// <stem>.<renderer>.difference.png and <stem>.<renderer>.flip.png (magma.h). Stems hold no dot (names.h), so no two
// pictures share a name.
#pragma once

#include <filesystem>
#include <span>
#include <string>

#include "cache/base/result.h"
#include "tools/evaluate/metrics/images.h"

namespace farcell {

inline constexpr float kDifferenceGain = 4;  // |d| is shown this many times brighter

Result<> writeReferencePicture(const std::filesystem::path& directory, const std::string& stem,
                               const ReferenceImage& reference, const Colour& background);

struct RendererPicture {
  std::string stem;  // of its camera
  std::string renderer;
  TestImage image;
  std::span<const float> flip;  // flipErrors() of it, 1 a pixel
};
// The renderer's picture, its difference from the reference, and its FLIP map.
Result<> writeRendererPictures(const std::filesystem::path& directory, const RendererPicture& picture,
                               const ReferenceImage& reference, const Colour& background);

// Of the frame of a path in which a renderer flickers most; each of 3 values a pixel, 0-255.
struct WorstFrame {
  std::string name;  // <stem of the path>.<renderer>
  int width = 0, height = 0;
  std::span<const float> before, now;  // the renderer's pictures, composited
  std::span<const float> reference;    // of `now`
  std::span<const float> flicker;      // measureChange()'s map
};
// <name>.worst-before.png, .worst.png, .worst-reference.png and .worst-flicker.png, which is kDifferenceGain brighter.
Result<> writeWorstFrame(const std::filesystem::path& directory, const WorstFrame& frame);

}  // namespace farcell
