// Pictures in the formats that OpenImageIO writes. Extraction alone needs it: other programs write PNG by libpng
// (tools/image), which starts at once.
#pragma once

#include <filesystem>

#include "tools/image/png.h"

namespace farcell {

// The format by the name's ending: .png or .tif. io where the file cannot be written: then there is none.
Result<> writeImageFile(const std::filesystem::path& path, const Picture& picture);

}  // namespace farcell
