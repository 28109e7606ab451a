// Extensions of glTF that a file says it cannot be read without.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "cache/base/result.h"

namespace farcell {

// unsupported, by name, for the first of "extensionsRequired" that is not read here; others a file only uses are
// ignored. `root`: checked (gltf_shape.h).
Result<> checkRequiredExtensions(const std::string& path, const nlohmann::json& root);

}  // namespace farcell
