#include "tests/bench/wscg2010/draw/painter.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/type_ptr.hpp>

#include "shaders/shared/shading.h"
#include "tests/bench/wscg2010/draw/shader_files.h"

namespace farcell::wscg {

namespace {

constexpr double kNear = 1e-3;
constexpr const char* kShaders = "tests/bench/wscg2010/shaders/";

Result<std::string> shaderSource(const std::string& path) {
  const std::string_view text = shaderText(path);
  if (text.data() == nullptr) return fail(ErrorKind::notFound, "no shader '{}'", path);
  return std::string(text);
}

Result<GlProgram> program(const std::string& name) {
  return loadProgram({fmt::format("{}{}.vert", kShaders, name), fmt::format("{}{}.frag", kShaders, name), {}},
                     shaderSource);
}

uint32_t litColour(uint32_t albedo, float light) {
  uint32_t packed = 0;
  for (int shift = 0; shift < 24; shift += 8)
    packed |= static_cast<uint32_t>(std::lround(static_cast<float>(albedo >> shift & 255) * light)) << shift;
  return packed;
}

void setUniform(GLuint name, GLint place, glm::dvec3 v) {
  glProgramUniform3f(name, place, static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z));
}

VertexBuffer uploadVertices(std::span<const ColouredVertex> vertices) {
  VertexBuffer result{createBuffer(), static_cast<GLsizei>(vertices.size())};
  glNamedBufferStorage(result.buffer.name(), static_cast<GLsizeiptr>(std::max<size_t>(1, vertices.size_bytes())),
                       vertices.empty() ? nullptr : vertices.data(), 0);
  return result;
}

}  // namespace

VertexBuffer uploadTriangles(std::span<const Triangle> triangles, glm::vec3 sun) {
  std::vector<ColouredVertex> vertices;
  vertices.reserve(3 * triangles.size());
  for (const Triangle& triangle : triangles) {
    const float light = shared::lightFactor(triangle.normal, sun);
    for (size_t k = 0; k < 3; ++k) vertices.push_back({triangle.corners[k], litColour(triangle.colours[k], light)});
  }
  return uploadVertices(vertices);
}

GlTexture uploadImage(int width, int height, std::span<const uint8_t> rgba, Filter filter) {
  GlTexture texture = createTexture(GL_TEXTURE_2D);
  glTextureStorage2D(texture.name(), 1, GL_RGBA8, width, height);
  glTextureSubImage2D(texture.name(), 0, 0, 0, width, height, GL_RGBA, GL_UNSIGNED_BYTE, rgba.data());
  const GLint filtering = filter == Filter::nearest ? GL_NEAREST : GL_LINEAR;
  glTextureParameteri(texture.name(), GL_TEXTURE_MIN_FILTER, filtering);
  glTextureParameteri(texture.name(), GL_TEXTURE_MAG_FILTER, filtering);
  glTextureParameteri(texture.name(), GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
  glTextureParameteri(texture.name(), GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
  return texture;
}

glm::mat4 clipFromWorld(const Camera& camera, int width, int height) {
  const CameraAxes axes = cameraAxes(camera);
  const double tanY = std::tan(camera.fovYRad / 2), tanX = tanY * width / height;
  const std::array<glm::dvec3, 4> rows = {axes.right / tanX, axes.up / tanY, glm::dvec3(0), -axes.back};
  glm::mat4 clip(0);
  for (int row = 0; row < 4; ++row) {
    for (int column = 0; column < 3; ++column)
      clip[column][row] = static_cast<float>(rows[static_cast<size_t>(row)][column]);
    clip[3][row] = static_cast<float>(row == 2 ? kNear : -glm::dot(rows[static_cast<size_t>(row)], camera.position));
  }
  return clip;
}

Painter::Painter(int width, int height, Programs programs)
    : width_(width),
      height_(height),
      programs_(std::move(programs)),
      target_(width, height, 1, false),
      vertices_(createVertexArray()),
      bare_(createVertexArray()) {
  const GLuint billboard = programs_.billboard.name();
  places_.solidClip = glGetUniformLocation(programs_.solid.name(), "clipFromWorld");
  places_.clip = glGetUniformLocation(billboard, "clipFromWorld");
  places_.origin = glGetUniformLocation(billboard, "origin");
  places_.alongX = glGetUniformLocation(billboard, "alongX");
  places_.alongY = glGetUniformLocation(billboard, "alongY");
  places_.blended = glGetUniformLocation(billboard, "blended");
  for (const GLuint attribute : {0u, 1u}) {
    glEnableVertexArrayAttrib(vertices_.name(), attribute);
    glVertexArrayAttribBinding(vertices_.name(), attribute, 0);
  }
  glVertexArrayAttribFormat(vertices_.name(), 0, 3, GL_FLOAT, GL_FALSE, offsetof(ColouredVertex, position));
  glVertexArrayAttribFormat(vertices_.name(), 1, 4, GL_UNSIGNED_BYTE, GL_TRUE, offsetof(ColouredVertex, colour));
}

Result<Painter> Painter::create(int width, int height) {
  Programs programs;
  FARCELL_ASSIGN(programs.solid, program("solid"));
  FARCELL_ASSIGN(programs.billboard, program("billboard"));
  return Painter(width, height, std::move(programs));
}

void Painter::begin(const Camera& camera) {
  target_.begin();
  clip_ = clipFromWorld(camera, width_, height_);
  glProgramUniformMatrix4fv(programs_.solid.name(), places_.solidClip, 1, GL_FALSE, glm::value_ptr(clip_));
  glProgramUniformMatrix4fv(programs_.billboard.name(), places_.clip, 1, GL_FALSE, glm::value_ptr(clip_));
  glClipControl(GL_LOWER_LEFT, GL_ZERO_TO_ONE);
  glEnable(GL_DEPTH_TEST);
  glDepthFunc(GL_GEQUAL);
  glDisable(GL_CULL_FACE);
  glDisable(GL_BLEND);
}

void Painter::bindVertices(GLuint buffer) const {
  glUseProgram(programs_.solid.name());
  glVertexArrayVertexBuffer(vertices_.name(), 0, buffer, 0, sizeof(ColouredVertex));
  glBindVertexArray(vertices_.name());
}

void Painter::drawTriangles(const VertexBuffer& triangles) {
  bindVertices(triangles.buffer.name());
  glDrawArrays(GL_TRIANGLES, 0, triangles.count);
}

void Painter::drawLines(std::span<const ColouredVertex> ends) {
  const VertexBuffer lines = uploadVertices(ends);
  bindVertices(lines.buffer.name());
  glDisable(GL_DEPTH_TEST);
  glDrawArrays(GL_LINES, 0, lines.count);
  glEnable(GL_DEPTH_TEST);
}

void Painter::beginBillboards(const DrawSettings& settings) {
  const bool blended = settings.rim == Rim::blended;
  glUseProgram(programs_.billboard.name());
  glBindVertexArray(bare_.name());
  glProgramUniform1i(programs_.billboard.name(), places_.blended, blended ? 1 : 0);
  blended ? glEnable(GL_BLEND) : glDisable(GL_BLEND);
  glBlendFunc(GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
}

void Painter::drawBillboard(const Billboard& billboard, const GlTexture& texture) {
  const GLuint name = programs_.billboard.name();
  setUniform(name, places_.origin, billboard.origin);
  setUniform(name, places_.alongX, billboard.alongX);
  setUniform(name, places_.alongY, billboard.alongY);
  glBindTextureUnit(0, texture.name());
  glDrawArrays(GL_TRIANGLE_STRIP, 0, 4);
}

void Painter::drawBillboards(std::span<const Billboard> billboards, const DrawSettings& settings) {
  beginBillboards(settings);
  for (const Billboard& billboard : billboards)
    drawBillboard(billboard,
                  uploadImage(billboard.image->width, billboard.image->height, billboard.image->rgba, settings.filter));
}

FrameImage Painter::read() const { return {width_, height_, target_.readColour(), {}}; }

void Painter::finish() const { glFinish(); }

}  // namespace farcell::wscg
