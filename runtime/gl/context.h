// An OpenGL 4.5 core context: without a window here, of a window in gl/window.
#pragma once

#include <memory>
#include <string>

#include "cache/base/result.h"

namespace farcell {

// Debug builds ask drivers for contexts that tell what is wrong.
#ifdef NDEBUG
inline constexpr bool kDebugContext = false;
#else
inline constexpr bool kDebugContext = true;
#endif

class GlContext {
 public:
  // What a platform made; its destructor ends the context.
  struct Platform {
    Platform() = default;
    Platform(const Platform&) = delete;
    Platform& operator=(const Platform&) = delete;
    virtual ~Platform() = default;
  };
  // Headless through EGL: the device platform of a GPU's driver first, Mesa's surfaceless platform second.
  // Current on the calling thread until destroyed. unsupported when no 4.5 core context can be had, saying what was
  // tried.
  static Result<GlContext> createHeadless();
  // REQUIRES: the platform's context is current on the calling thread.
  explicit GlContext(std::unique_ptr<Platform> platform);

  const std::string& renderer() const { return renderer_; }  // GL_RENDERER, GL_VERSION: "llvmpipe (...), 4.5 ..."

 private:
  std::unique_ptr<Platform> platform_;
  std::string renderer_;
};

}  // namespace farcell
