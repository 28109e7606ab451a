// The shader files, built into the program (cmake/embed.cmake writes the definition).
#pragma once

#include <string_view>

namespace farcell {

// Text of the file at `path` (from the repository root, e.g. "shaders/gl/triangles.vert"); data() is null when there is
// none.
std::string_view embeddedShader(std::string_view path);

}  // namespace farcell
