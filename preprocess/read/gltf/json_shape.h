// Which members of a JSON object are read, and of what kind each must be. What follows a check may then use get<>
// without a thought: every member there is of its kind, and nothing else is there.
#pragma once

#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <span>

#include "preprocess/read/gltf/place.h"

namespace farcell {

enum class JsonKind : uint8_t {
  index,   // integer, 0 <= value < 2^31 - 1
  size,    // integer, 0 <= value < 2^63
  number,  // finite; stored as a double
  string,
  boolean,
  object,   // of `shape`
  indices,  // object of any members, each an index
};

struct JsonShape;

struct JsonMember {
  const char* name;
  JsonKind kind;
  bool isRequired = false;
  const JsonShape* shape = nullptr;
  bool isList = false;
  size_t length = 0;  // of the list, where it is fixed
};

struct JsonShape {
  std::span<const JsonMember> members;
};

// An object of the members in `shape` that `object` has, moved out of it. Members of other names are left behind, as
// glTF asks of readers. corrupt where one is missing or of another kind.
Result<nlohmann::json> takeShape(const std::string& path, const JsonShape& shape, nlohmann::json& object);

}  // namespace farcell
