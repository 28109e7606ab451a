// The bench's own shaders, embedded at build time.
#pragma once

#include <string_view>

namespace farcell::wscg {

// By its path from the repository's root; empty for a file that was not embedded.
std::string_view shaderText(std::string_view path);

}  // namespace farcell::wscg
