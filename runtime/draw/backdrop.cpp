#include "runtime/draw/backdrop.h"

#include <cmath>
#include <glm/geometric.hpp>

namespace farcell {
namespace {

// Locations of uniforms in shaders/gl/backdrop.frag.
enum : GLint { kZenith, kHorizon, kNadir, kUp, kTangents };

void setColour(const GlProgram& program, GLint location, const std::array<uint8_t, 3>& colour) {
  glProgramUniform4f(program.name(), location, colour[0] / 255.0f, colour[1] / 255.0f, colour[2] / 255.0f, 1.0f);
}

}  // namespace

Result<BackdropPainter> BackdropPainter::create() {
  FARCELL_ASSIGN(GlProgram program, loadProgram({"shaders/gl/whole_picture.vert", "shaders/gl/backdrop.frag", {}}));
  return BackdropPainter(std::move(program));
}

void BackdropPainter::paint(GLuint picture, glm::ivec2 sizePx, const Backdrop& backdrop, const Camera& camera,
                            glm::dvec3 up, GLuint framebuffer) const {
  const CameraAxes axes = cameraAxes(camera);
  const double tanY = std::tan(camera.fovYRad / 2);
  const glm::vec3 upInView(glm::dot(up, axes.right), glm::dot(up, axes.up), glm::dot(up, axes.back));
  setColour(program_, kZenith, backdrop.zenith);
  setColour(program_, kHorizon, backdrop.horizon);
  setColour(program_, kNadir, backdrop.nadir);
  glProgramUniform3f(program_.name(), kUp, upInView.x, upInView.y, upInView.z);
  glProgramUniform2f(program_.name(), kTangents, static_cast<float>(tanY * sizePx.x / sizePx.y),
                     static_cast<float>(tanY));
  glBindFramebuffer(GL_FRAMEBUFFER, framebuffer);
  glViewport(0, 0, sizePx.x, sizePx.y);
  glDisable(GL_DEPTH_TEST);
  glDisable(GL_CULL_FACE);
  glDisable(GL_BLEND);
  glUseProgram(program_.name());
  glBindVertexArray(bare_.name());
  glBindTextureUnit(0, picture);
  glDrawArrays(GL_TRIANGLES, 0, 3);
}

}  // namespace farcell
