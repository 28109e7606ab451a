// The pictures of a report, all over the background: <stem>.reference.png, <stem>.<renderer>.png and
// <stem>.<renderer>.difference.png. Stems hold no dot (names.h), so no two pictures share a name.
#pragma once

#include <filesystem>
#include <string>

#include "cache/base/result.h"
#include "tools/evaluate/metrics/images.h"

namespace farcell {

inline constexpr float kDifferenceGain = 4;  // |d| is shown this many times brighter

Result<> writeReferencePicture(const std::filesystem::path& directory, const std::string& stem,
                               const ReferenceImage& reference, const Colour& background);
// The renderer's picture and its difference from the reference.
Result<> writeRendererPictures(const std::filesystem::path& directory, const std::string& stem,
                               const std::string& renderer, const ReferenceImage& reference, const TestImage& test,
                               const Colour& background);

}  // namespace farcell
