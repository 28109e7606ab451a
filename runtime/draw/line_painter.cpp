#include "runtime/draw/line_painter.h"

#include <cstddef>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace farcell {
namespace {

constexpr uint8_t kAlpha = 200;

void addLine(std::vector<LineEnd>& lines, glm::dvec3 from, glm::dvec3 to, std::array<uint8_t, 3> colour) {
  const std::array<uint8_t, 4> rgba = {colour[0], colour[1], colour[2], kAlpha};
  lines.push_back({glm::vec3(from), rgba});
  lines.push_back({glm::vec3(to), rgba});
}

}  // namespace

void addBox(std::vector<LineEnd>& lines, const GridBox& box, glm::dvec3 eyeSteps, std::array<uint8_t, 3> colour) {
  const auto corner = [&](int i) {
    return glm::dvec3(i & 1 ? box.max.x : box.min.x, i & 2 ? box.max.y : box.min.y, i & 4 ? box.max.z : box.min.z) -
           eyeSteps;
  };
  for (int i = 0; i < 8; ++i)
    for (int axis = 1; axis < 8; axis *= 2)
      if ((i & axis) == 0) addLine(lines, corner(i), corner(i | axis), colour);
}

void addBillboard(std::vector<LineEnd>& lines, const shared::ImpostorInstance& instance,
                  std::array<uint8_t, 3> colour) {
  const shared::ImpostorView& view = instance.views[0];
  if (view.boxMin.x > view.boxMax.x) return;
  const double texel = static_cast<double>(instance.boxMin.w);
  const glm::dvec3 right(view.textureX.x, view.textureX.y, view.textureX.z);
  const glm::dvec3 up(view.textureY.x, view.textureY.y, view.textureY.z);
  const glm::dvec3 toward = glm::normalize(glm::dvec3(view.textureZ.x, view.textureZ.y, view.textureZ.z));
  const glm::dvec3 middle(0.5f * (glm::vec3(instance.boxMin) + glm::vec3(instance.boxMax)));
  const auto corner = [&](float x, float y) {
    const glm::dvec3 onPlane =
        texel * texel *
        (right * static_cast<double>(x - view.textureX.w) + up * static_cast<double>(y - view.textureY.w));
    const glm::dvec3 local = onPlane + toward * glm::dot(toward, middle);
    return glm::dvec3(glm::vec3(instance.centre)) + static_cast<double>(instance.centre.w) * local;
  };
  const std::array<glm::dvec3, 4> corners = {corner(view.boxMin.x, view.boxMin.y), corner(view.boxMax.x, view.boxMin.y),
                                             corner(view.boxMax.x, view.boxMax.y),
                                             corner(view.boxMin.x, view.boxMax.y)};
  for (size_t i = 0; i < 4; ++i) addLine(lines, corners[i], corners[(i + 1) % 4], colour);
}

Result<LinePainter> LinePainter::create() {
  FARCELL_ASSIGN(GlProgram program, loadProgram({"shaders/gl/lines.vert", "shaders/gl/lines.frag", {}}));
  return LinePainter(std::move(program));
}

LinePainter::LinePainter(GlProgram program)
    : program_(std::move(program)), ends_(createBuffer()), layout_(createVertexArray()) {
  const GLuint name = layout_.name();
  for (GLuint attribute = 0; attribute < 2; ++attribute) {
    glEnableVertexArrayAttrib(name, attribute);
    glVertexArrayAttribBinding(name, attribute, 0);
  }
  glVertexArrayAttribFormat(name, 0, 3, GL_FLOAT, GL_FALSE, offsetof(LineEnd, position));
  glVertexArrayAttribFormat(name, 1, 4, GL_UNSIGNED_BYTE, GL_TRUE, offsetof(LineEnd, colour));
}

void LinePainter::paint(std::span<const LineEnd> lines) {
  if (lines.empty()) return;
  glNamedBufferData(ends_.name(), static_cast<GLsizeiptr>(lines.size_bytes()), lines.data(), GL_STREAM_DRAW);
  glVertexArrayVertexBuffer(layout_.name(), 0, ends_.name(), 0, sizeof(LineEnd));
  glBindVertexArray(layout_.name());
  glUseProgram(program_.name());
  glDisable(GL_DEPTH_TEST);
  glDepthMask(GL_FALSE);
  glEnable(GL_BLEND);
  glBlendFunc(GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
  glDrawArrays(GL_LINES, 0, static_cast<GLsizei>(lines.size()));
}

}  // namespace farcell
