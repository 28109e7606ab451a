// The baselines' own shaders, embedded at build time.
#pragma once

#include <string_view>

namespace farcell {

// By its path from the repository's root; data() is null for a file that was not embedded.
std::string_view baselineShader(std::string_view path);

}  // namespace farcell
