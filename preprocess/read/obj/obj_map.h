// A texture as a material of an MTL file names it.
#pragma once

#include <filesystem>
#include <glm/vec2.hpp>
#include <optional>
#include <string_view>

namespace farcell {

struct ObjMap {
  std::filesystem::path name;  // relative and inside its directory
  bool clamped = false;        // -clamp on; else the image repeats
  glm::vec2 scale{1};          // -s: texture coordinates times it,
  glm::vec2 offset{0};         // -o: plus it
};

// The rest of a map_Kd statement: options, those that say nothing about colours passed over, and a name, perhaps with
// blanks or backslashes in it. A name that leads elsewhere (such as C:\models\wall.png) is looked for by its last part.
// Nothing when there is no name.
std::optional<ObjMap> parseObjMap(std::string_view rest);

// Whether a name leads nowhere but into the directory it is taken from.
bool staysInside(const std::filesystem::path& name);

}  // namespace farcell
