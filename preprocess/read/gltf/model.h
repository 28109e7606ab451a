// The structure of a glTF file, by tinygltf: it sees checked JSON only, and neither bytes nor names of files.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "cache/base/result.h"

namespace tinygltf {
class Model;
}

namespace farcell {

// From the checked JSON (gltf_shape.h), whose buffers, views and images it takes away: tinygltf would open whatever
// they name. An accessor without a view names the one after the last.
Result<tinygltf::Model> loadModel(const std::string& path, nlohmann::json root);

}  // namespace farcell
