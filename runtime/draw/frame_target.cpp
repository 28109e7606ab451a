#include "runtime/draw/frame_target.h"

#include <array>

#include "cache/base/check.h"
#include "runtime/draw/read_back.h"

namespace farcell {
namespace {

GlTexture createAttachment(GLenum format, int width, int height, int samples) {
  GlTexture texture = createTexture(samples > 1 ? GL_TEXTURE_2D_MULTISAMPLE : GL_TEXTURE_2D);
  if (samples > 1) {
    glTextureStorage2DMultisample(texture.name(), samples, format, width, height, GL_TRUE);
  } else {
    glTextureStorage2D(texture.name(), 1, format, width, height);
  }
  return texture;
}

constexpr std::array<GLenum, 2> kDrawBuffers = {GL_COLOR_ATTACHMENT0, GL_COLOR_ATTACHMENT1};

}  // namespace

FrameTarget::FrameTarget(int width, int height, int samples, bool withCoverage)
    : width_(width), height_(height), samples_(samples), withCoverage_(withCoverage) {
  drawn_ = makeAttachments(samples, true);
  if (samples > 1) resolved_ = makeAttachments(1, false);
}

FrameTarget::Attachments FrameTarget::makeAttachments(int samples, bool withDepth) const {
  Attachments result;
  result.framebuffer = createFramebuffer();
  const GLuint framebuffer = result.framebuffer.name();
  result.colour = createAttachment(GL_RGBA8, width_, height_, samples);
  glNamedFramebufferTexture(framebuffer, GL_COLOR_ATTACHMENT0, result.colour.name(), 0);
  if (withCoverage_) {
    result.coverage = createAttachment(GL_R8, width_, height_, samples);
    glNamedFramebufferTexture(framebuffer, GL_COLOR_ATTACHMENT1, result.coverage.name(), 0);
  }
  if (withDepth) {
    result.depth = createAttachment(GL_DEPTH_COMPONENT32F, width_, height_, samples);
    glNamedFramebufferTexture(framebuffer, GL_DEPTH_ATTACHMENT, result.depth.name(), 0);
  }
  glNamedFramebufferDrawBuffers(framebuffer, withCoverage_ ? 2 : 1, kDrawBuffers.data());
  FARCELL_CHECK_EQ(glCheckNamedFramebufferStatus(framebuffer, GL_FRAMEBUFFER),
                   static_cast<GLenum>(GL_FRAMEBUFFER_COMPLETE));
  return result;
}

void FrameTarget::begin() const {
  constexpr std::array<float, 4> kTransparent = {0, 0, 0, 0};
  constexpr float kInfinitelyFar = 0;
  const GLuint framebuffer = drawn_.framebuffer.name();
  glBindFramebuffer(GL_FRAMEBUFFER, framebuffer);
  glViewport(0, 0, width_, height_);
  glDepthMask(GL_TRUE);
  glClearNamedFramebufferfv(framebuffer, GL_COLOR, 0, kTransparent.data());
  if (withCoverage_) glClearNamedFramebufferfv(framebuffer, GL_COLOR, 1, kTransparent.data());
  glClearNamedFramebufferfv(framebuffer, GL_DEPTH, 0, &kInfinitelyFar);
}

void FrameTarget::resolve() const {
  if (samples_ == 1) return;
  const GLuint from = drawn_.framebuffer.name();
  const GLuint to = resolved_.framebuffer.name();
  for (int i = 0; i < (withCoverage_ ? 2 : 1); ++i) {
    glNamedFramebufferReadBuffer(from, kDrawBuffers[static_cast<size_t>(i)]);
    glNamedFramebufferDrawBuffer(to, kDrawBuffers[static_cast<size_t>(i)]);
    glBlitNamedFramebuffer(from, to, 0, 0, width_, height_, 0, 0, width_, height_, GL_COLOR_BUFFER_BIT, GL_NEAREST);
  }
}

std::vector<uint8_t> FrameTarget::readColour() const {
  return readBack(result().framebuffer.name(), GL_COLOR_ATTACHMENT0, GL_RGBA, width_, height_);
}

std::vector<uint8_t> FrameTarget::readCoverage() const {
  FARCELL_CHECK(withCoverage_);
  return readBack(result().framebuffer.name(), GL_COLOR_ATTACHMENT1, GL_RED, width_, height_);
}

}  // namespace farcell
