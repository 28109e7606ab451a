// GL objects as move-only handles. The empty state needs no context; a full one must die while its context is current.
#pragma once

#include <epoxy/gl.h>

#include <string_view>
#include <utility>

namespace farcell {

// Owns one GL name; Traits::destroy(name) ends it, Traits::kIdentifier is its kind for debug labels.
template <class Traits>
class GlHandle {
 public:
  GlHandle() = default;
  explicit GlHandle(GLuint name) : name_(name) {}
  GlHandle(GlHandle&& other) noexcept : name_(std::exchange(other.name_, 0u)) {}
  GlHandle& operator=(GlHandle&& other) noexcept {
    if (this != &other) {
      reset();
      name_ = std::exchange(other.name_, 0u);
    }
    return *this;
  }
  GlHandle(const GlHandle&) = delete;
  GlHandle& operator=(const GlHandle&) = delete;
  ~GlHandle() { reset(); }

  GLuint name() const { return name_; }
  explicit operator bool() const { return name_ != 0; }
  GLuint release() { return std::exchange(name_, 0u); }
  void reset() {
    if (name_ != 0) Traits::destroy(std::exchange(name_, 0u));
  }
  // What debuggers and driver messages call it.
  void label(std::string_view text) const {
    glObjectLabel(Traits::kIdentifier, name_, static_cast<GLsizei>(text.size()), text.data());
  }

 private:
  GLuint name_ = 0;
};

struct GlBufferTraits {
  static constexpr GLenum kIdentifier = GL_BUFFER;
  static void destroy(GLuint name) { glDeleteBuffers(1, &name); }
};
struct GlTextureTraits {
  static constexpr GLenum kIdentifier = GL_TEXTURE;
  static void destroy(GLuint name) { glDeleteTextures(1, &name); }
};
struct GlFramebufferTraits {
  static constexpr GLenum kIdentifier = GL_FRAMEBUFFER;
  static void destroy(GLuint name) { glDeleteFramebuffers(1, &name); }
};
struct GlVertexArrayTraits {
  static constexpr GLenum kIdentifier = GL_VERTEX_ARRAY;
  static void destroy(GLuint name) { glDeleteVertexArrays(1, &name); }
};
struct GlQueryTraits {
  static constexpr GLenum kIdentifier = GL_QUERY;
  static void destroy(GLuint name) { glDeleteQueries(1, &name); }
};
struct GlShaderTraits {
  static constexpr GLenum kIdentifier = GL_SHADER;
  static void destroy(GLuint name) { glDeleteShader(name); }
};
struct GlProgramTraits {
  static constexpr GLenum kIdentifier = GL_PROGRAM;
  static void destroy(GLuint name) { glDeleteProgram(name); }
};

using GlBuffer = GlHandle<GlBufferTraits>;
using GlTexture = GlHandle<GlTextureTraits>;
using GlFramebuffer = GlHandle<GlFramebufferTraits>;
using GlVertexArray = GlHandle<GlVertexArrayTraits>;
using GlQuery = GlHandle<GlQueryTraits>;
using GlShader = GlHandle<GlShaderTraits>;
using GlProgram = GlHandle<GlProgramTraits>;

inline GlBuffer createBuffer() {
  GLuint name = 0;
  glCreateBuffers(1, &name);
  return GlBuffer(name);
}
inline GlTexture createTexture(GLenum target) {
  GLuint name = 0;
  glCreateTextures(target, 1, &name);
  return GlTexture(name);
}
inline GlFramebuffer createFramebuffer() {
  GLuint name = 0;
  glCreateFramebuffers(1, &name);
  return GlFramebuffer(name);
}
inline GlVertexArray createVertexArray() {
  GLuint name = 0;
  glCreateVertexArrays(1, &name);
  return GlVertexArray(name);
}
inline GlQuery createQuery(GLenum target) {
  GLuint name = 0;
  glCreateQueries(target, 1, &name);
  return GlQuery(name);
}

}  // namespace farcell
