// Where in a glTF file something is wrong, for messages: "city.glb: accessors[3].count: expected ..., found ...".
#pragma once

#include <string>
#include <string_view>

#include "cache/base/result.h"

namespace farcell {

struct GltfPlace {
  std::string path;
  std::string where;  // in the JSON: "meshes[2].primitives[0]"

  GltfPlace in(std::string_view member) const { return {path, fmt::format("{}.{}", where, member)}; }
  [[nodiscard]] tl::unexpected<Error> bad(const std::string& expected, const std::string& found) const {
    return failed(ErrorKind::corrupt, expected, found);
  }
  [[nodiscard]] tl::unexpected<Error> failed(ErrorKind kind, const std::string& expected,
                                             const std::string& found) const {
    return fail(kind, "{}: {}: expected {}, found {}", path, where, expected, found);
  }
};

// Text of a file, short enough and without line ends for a message.
inline std::string inQuotes(std::string_view text) {
  constexpr size_t kMaxQuoted = 60;
  std::string shown(text.substr(0, kMaxQuoted));
  for (char& c : shown)
    if (static_cast<unsigned char>(c) < ' ') c = '?';
  return fmt::format("'{}{}'", shown, text.size() > kMaxQuoted ? "..." : "");
}

}  // namespace farcell
