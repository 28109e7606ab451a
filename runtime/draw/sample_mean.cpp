#include "runtime/draw/sample_mean.h"

#include <glm/common.hpp>
#include <glm/vec2.hpp>

#include "cache/base/check.h"
#include "runtime/draw/read_back.h"

namespace farcell {
namespace {

// In 1/32 of a pixel. Searched for 2, 4, 8 and 16 passes together (tests/bench/near/results.md).
constexpr std::array<std::array<int, 2>, kMostPasses> kMoves = {{{0, 0},
                                                                 {21, 2},
                                                                 {11, 1},
                                                                 {17, 29},
                                                                 {17, 3},
                                                                 {6, 31},
                                                                 {29, 29},
                                                                 {27, 1},
                                                                 {13, 27},
                                                                 {23, 30},
                                                                 {15, 31},
                                                                 {3, 0},
                                                                 {14, 13},
                                                                 {8, 2},
                                                                 {26, 22},
                                                                 {26, 3}}};

// Locations of uniforms in shaders/gl/sample_mean.frag, and how many steps there is room for.
enum : GLint { kCount, kSteps };
constexpr size_t kMostSamples = 16;

GlTexture createMean(GLenum format, int width, int height) {
  GlTexture texture = createTexture(GL_TEXTURE_2D);
  glTextureStorage2D(texture.name(), 1, format, width, height);
  return texture;
}

double centred(int move) { return (move < 16 ? move : move - 32) / 32.0; }

}  // namespace

glm::dvec2 sampleMove(int pass) {
  const auto& move = kMoves.at(static_cast<size_t>(pass));
  return {centred(move[0]), centred(move[1])};
}

Result<SampleMean> SampleMean::create(int width, int height, bool withCoverage, std::vector<glm::vec2> positions) {
  if (positions.empty() || positions.size() > kMostSamples)
    return fail(ErrorKind::unsupported,
                "this OpenGL has {} samples per pixel where {} are asked for, at most {} can be", positions.size(),
                kMultisamples, kMostSamples);
  std::vector<std::string> defines;
  if (withCoverage) defines.emplace_back("COVERAGE");
  FARCELL_ASSIGN(GlProgram program,
                 loadProgram({"shaders/gl/whole_picture.vert", "shaders/gl/sample_mean.frag", defines}));
  return SampleMean(width, height, withCoverage, std::move(positions), std::move(program));
}

// 16 bits: half floats would round what the last of many passes adds away.
SampleMean::SampleMean(int width, int height, bool withCoverage, std::vector<glm::vec2> positions, GlProgram program)
    : width_(width),
      height_(height),
      withCoverage_(withCoverage),
      positions_(std::move(positions)),
      program_(std::move(program)),
      colour_(createMean(GL_RGBA16, width, height)),
      framebuffer_(createFramebuffer()),
      bare_(createVertexArray()) {
  constexpr std::array<GLenum, 2> kDrawBuffers = {GL_COLOR_ATTACHMENT0, GL_COLOR_ATTACHMENT1};
  const GLuint name = framebuffer_.name();
  glNamedFramebufferTexture(name, GL_COLOR_ATTACHMENT0, colour_.name(), 0);
  if (withCoverage) {
    coverage_ = createMean(GL_R16, width, height);
    glNamedFramebufferTexture(name, GL_COLOR_ATTACHMENT1, coverage_.name(), 0);
  }
  glNamedFramebufferDrawBuffers(name, withCoverage ? 2 : 1, kDrawBuffers.data());
  FARCELL_CHECK_EQ(glCheckNamedFramebufferStatus(name, GL_FRAMEBUFFER), static_cast<GLenum>(GL_FRAMEBUFFER_COMPLETE));
}

void SampleMean::add(const FrameTarget& frame) {
  FARCELL_CHECK(passes_ < kMostPasses);
  const glm::dvec2 move = sampleMove(passes_++);
  std::vector<glm::ivec2> steps;
  for (const glm::vec2& position : positions_) steps.emplace_back(glm::floor(glm::dvec2(position) + move));
  glProgramUniform1i(program_.name(), kCount, static_cast<GLint>(steps.size()));
  glProgramUniform2iv(program_.name(), kSteps, static_cast<GLsizei>(steps.size()), &steps[0].x);
  glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_.name());
  glViewport(0, 0, width_, height_);
  glDisable(GL_DEPTH_TEST);
  glDisable(GL_CULL_FACE);
  glEnable(GL_BLEND);
  glBlendColor(0.0f, 0.0f, 0.0f, 1.0f / static_cast<float>(passes_));
  glBlendFunc(GL_CONSTANT_ALPHA, GL_ONE_MINUS_CONSTANT_ALPHA);
  glUseProgram(program_.name());
  glBindVertexArray(bare_.name());
  glBindTextureUnit(0, frame.drawnColour());
  if (withCoverage_) glBindTextureUnit(1, frame.drawnCoverage());
  glDrawArrays(GL_TRIANGLES, 0, 3);
}

std::vector<uint8_t> SampleMean::readColour() const {
  return readBack(framebuffer_.name(), GL_COLOR_ATTACHMENT0, GL_RGBA, width_, height_);
}

std::vector<uint8_t> SampleMean::readCoverage() const {
  FARCELL_CHECK(withCoverage_);
  return readBack(framebuffer_.name(), GL_COLOR_ATTACHMENT1, GL_RED, width_, height_);
}

}  // namespace farcell
