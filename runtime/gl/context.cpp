#include "runtime/gl/context.h"

#include <epoxy/gl.h>

#include <cstdio>
#include <utility>

namespace farcell {
namespace {

// What GL says while we work: errors and undefined behaviour are ours, and worth a line each.
void onMessage(GLenum, GLenum type, GLuint, GLenum severity, GLsizei, const GLchar* message, const void*) {
  const bool serious = type == GL_DEBUG_TYPE_ERROR || type == GL_DEBUG_TYPE_UNDEFINED_BEHAVIOR;
  if (serious || severity == GL_DEBUG_SEVERITY_HIGH) std::fprintf(stderr, "OpenGL: %s\n", message);
}

}  // namespace

GlContext::GlContext(std::unique_ptr<Platform> platform)
    : platform_(std::move(platform)),
      renderer_(fmt::format("{}, {}", reinterpret_cast<const char*>(glGetString(GL_RENDERER)),
                            reinterpret_cast<const char*>(glGetString(GL_VERSION)))) {
  if (!kDebugContext) return;
  glEnable(GL_DEBUG_OUTPUT);
  glEnable(GL_DEBUG_OUTPUT_SYNCHRONOUS);
  glDebugMessageCallback(onMessage, nullptr);
}

}  // namespace farcell
