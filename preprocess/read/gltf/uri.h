// What a glTF file may name as its buffers and images: files beside it, and base64 text in the JSON.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string_view>
#include <vector>

#include "preprocess/read/gltf/place.h"

namespace farcell {

bool isDataUri(std::string_view uri);
// "data:...;base64,...", of at most maxBytes once decoded (else exhausted).
Result<std::vector<std::byte>> decodeDataUri(const GltfPlace& place, std::string_view uri, uint64_t maxBytes);
// A path below the file's own directory: percent codes decoded; no scheme, no absolute path, no "..".
Result<std::filesystem::path> pathFromUri(const GltfPlace& place, std::string_view uri);

}  // namespace farcell
