// An OpenGL 4.5 core context without a window.
#pragma once

#include <memory>
#include <string>

#include "cache/base/result.h"

namespace farcell {

class GlContext {
 public:
  // Headless through EGL: the device platform of a GPU's driver first, Mesa's surfaceless platform second.
  // Current on the calling thread until destroyed. unsupported when no 4.5 core context can be had, saying what was
  // tried.
  static Result<GlContext> createHeadless();
  GlContext(GlContext&&) noexcept;
  GlContext& operator=(GlContext&&) noexcept;
  ~GlContext();

  const std::string& renderer() const;  // GL_RENDERER, GL_VERSION: "llvmpipe (...), 4.5 ..."

 private:
  struct Impl;
  explicit GlContext(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace farcell
