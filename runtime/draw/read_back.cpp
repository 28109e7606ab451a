#include "runtime/draw/read_back.h"

#include <algorithm>

namespace farcell {

std::vector<uint8_t> readBack(GLuint framebuffer, GLenum attachment, GLenum format, int width, int height) {
  const size_t rowBytes = static_cast<size_t>(width) * (format == GL_RGBA ? 4 : 1);
  std::vector<uint8_t> bottomUp(rowBytes * static_cast<size_t>(height));
  glNamedFramebufferReadBuffer(framebuffer, attachment);
  glBindFramebuffer(GL_READ_FRAMEBUFFER, framebuffer);
  glPixelStorei(GL_PACK_ALIGNMENT, 1);
  glReadPixels(0, 0, width, height, format, GL_UNSIGNED_BYTE, bottomUp.data());
  std::vector<uint8_t> topDown(bottomUp.size());
  for (size_t y = 0; y < static_cast<size_t>(height); ++y)
    std::copy_n(bottomUp.begin() + static_cast<ptrdiff_t>(y * rowBytes), rowBytes,
                topDown.end() - static_cast<ptrdiff_t>((y + 1) * rowBytes));
  return topDown;
}

}  // namespace farcell
