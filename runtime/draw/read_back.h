// Pictures brought back from the GPU.
#pragma once

#include <cstdint>
#include <vector>

#include "runtime/gl/objects.h"

namespace farcell {

// 8 bits a channel of `format` (GL_RGBA: 4, GL_RED: 1), rounded; row 0 is the top row. Waits for the GPU.
std::vector<uint8_t> readBack(GLuint framebuffer, GLenum attachment, GLenum format, int width, int height);

}  // namespace farcell
