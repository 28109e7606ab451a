#include "tools/evaluate/baselines/octahedral.h"

#include <algorithm>
#include <array>
#include <bit>
#include <chrono>
#include <cmath>
#include <glm/geometric.hpp>
#include <set>

#include "cache/base/process.h"
#include "runtime/gl/program.h"
#include "tools/evaluate/baselines/shader_files.h"

namespace farcell {
namespace {

Result<std::string> shaderSource(const std::string& path) {
  const std::string_view text = baselineShader(path);
  if (text.data() == nullptr) return fail(ErrorKind::notFound, "no shader '{}'", path);
  return std::string(text);
}

GlTexture makeArray(GLenum internal, GLenum format, int edge, int levels, GLenum minified,
                    const std::vector<std::vector<uint8_t>>& images) {
  GlTexture texture = createTexture(GL_TEXTURE_2D_ARRAY);
  glTextureStorage3D(texture.name(), levels, internal, edge, edge, static_cast<GLsizei>(images.size()));
  glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
  for (size_t i = 0; i < images.size(); ++i)
    glTextureSubImage3D(texture.name(), 0, 0, 0, static_cast<GLint>(i), edge, edge, 1, format, GL_UNSIGNED_BYTE,
                        images[i].data());
  glTextureParameteri(texture.name(), GL_TEXTURE_MIN_FILTER, static_cast<GLint>(minified));
  glTextureParameteri(texture.name(), GL_TEXTURE_MAG_FILTER, GL_LINEAR);
  glTextureParameteri(texture.name(), GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
  glTextureParameteri(texture.name(), GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
  return texture;
}

using Triple = std::array<glm::vec3, 3>;

// As the pack's store charges them.
uint64_t pageBytes(const Directory& directory, const std::set<uint32_t>& pages) {
  uint64_t bytes = 0;
  for (const uint32_t page : pages) bytes += directory.pages[page].decodedBytes;
  return bytes;
}

void addViewPages(const Directory& directory, const CutEntry& entry, ImpostorKind kind, std::set<uint32_t>& pages) {
  const CellRecord& cell = directory.cells[entry.cell];
  const Viewpoints& viewpoints = Viewpoints::of(cell.form.views);
  std::set<int> groups = {viewpoints.group(static_cast<int>(entry.view))};
  if (kind == ImpostorKind::depthCorrected) groups.insert(viewpoints.group(static_cast<int>(entry.secondView)));
  if (kind == ImpostorKind::blended)
    for (const int view : entry.blend.views) groups.insert(viewpoints.group(view));
  for (uint32_t i = 0; i < cell.viewPageCount; ++i) {
    const uint32_t page = cell.firstViewPage + i;
    if (groups.contains(static_cast<int>(directory.pages[page].group))) pages.insert(page);
  }
}

}  // namespace

OctahedralImpostor::OctahedralImpostor(GlProgram program, const OctahedralViews& views)
    : program_(std::move(program)),
      colours_(makeArray(GL_RGBA8, GL_RGBA, views.edge, std::bit_width(static_cast<unsigned>(views.edge)),
                         GL_LINEAR_MIPMAP_LINEAR, views.colours)),
      depths_(makeArray(GL_R8, GL_RED, views.edge, 1, GL_LINEAR, views.depths)),
      nothing_(createVertexArray()),
      edge_(views.edge),
      centre_(views.centre),
      unit_(views.unit),
      halfExtent_(views.halfExtent),
      grid_(views.grid),
      axes_(views.axes) {
  glGenerateTextureMipmap(colours_.name());
}

Result<OctahedralImpostor> OctahedralImpostor::create(GlContext&, const OctahedralViews& views) {
  const std::string directory = "tools/evaluate/baselines/shaders/";
  FARCELL_ASSIGN(GlProgram program,
                 loadProgram({directory + "octahedral.vert", directory + "octahedral.frag", {}}, shaderSource));
  return OctahedralImpostor(std::move(program), views);
}

void OctahedralImpostor::setUniforms(const Camera& camera, int width, int height) const {
  const GLuint program = program_.name();
  const auto place = [&](const char* name) { return glGetUniformLocation(program, name); };
  const auto set = [&](const char* name, glm::dvec3 v) {
    glProgramUniform3f(program, place(name), static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z));
  };
  const CameraAxes view = cameraAxes(camera);
  const double tanY = std::tan(camera.fovYRad / 2), tanX = tanY * width / height;
  const glm::dvec3 eye = (camera.position - centre_) / unit_;
  set("eye", eye);
  set("rayX", view.right * tanX);
  set("rayY", view.up * tanY);
  set("rayZ", -view.back);
  glProgramUniform1f(program, place("halfExtent"), static_cast<float>(halfExtent_));
  const OctahedralFrames chosen =
      octahedralFrames(glm::dvec3(glm::dot(eye, grid_[0]), glm::dot(eye, grid_[1]), glm::dot(eye, grid_[2])));
  Triple right, up, toward;
  std::array<float, 3> weights{};
  for (size_t k = 0; k < 3; ++k) {
    const ViewFrame& frame = axes_[static_cast<size_t>(chosen.frames[k])];
    right[k] = glm::vec3(frame.right);
    up[k] = glm::vec3(frame.up);
    toward[k] = glm::vec3(frame.toward);
    weights[k] = static_cast<float>(chosen.weights[k]);
  }
  glProgramUniform3fv(program, place("right"), 3, &right[0].x);
  glProgramUniform3fv(program, place("up"), 3, &up[0].x);
  glProgramUniform3fv(program, place("toward"), 3, &toward[0].x);
  glProgramUniform1fv(program, place("weights"), 3, weights.data());
  glProgramUniform1iv(program, place("layers"), 3, chosen.frames.data());
}

FrameStats OctahedralImpostor::draw(const Camera& camera, int width, int height, FrameImage* image) const {
  const FrameTarget target(width, height, 1, image != nullptr);
  glFinish();
  const auto start = std::chrono::steady_clock::now();
  const double startCpuSeconds = processCpuSeconds();
  target.begin();
  glDisable(GL_DEPTH_TEST);
  glDisable(GL_BLEND);
  glDisable(GL_CULL_FACE);
  glUseProgram(program_.name());
  setUniforms(camera, width, height);
  glBindTextureUnit(0, colours_.name());
  glBindTextureUnit(1, depths_.name());
  glBindVertexArray(nothing_.name());
  glDrawArrays(GL_TRIANGLES, 0, 3);
  target.resolve();
  glFinish();
  FrameStats stats;
  stats.wallMs = std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
  stats.cpuMs = (processCpuSeconds() - startCpuSeconds) * 1e3;
  stats.impostors = 1;
  stats.texels = 3 * static_cast<uint64_t>(edge_) * static_cast<uint64_t>(edge_);
  if (image != nullptr) *image = {width, height, target.readColour(), target.readCoverage()};
  return stats;
}

uint64_t residentBytes(const Directory& directory, const Cut& cut, ImpostorKind kind) {
  std::set<uint32_t> pages;
  for (const CutEntry& entry : cut.entries) {
    const CellRecord& cell = directory.cells[entry.cell];
    if (entry.representation == Representation::impostor) {
      addViewPages(directory, entry, kind, pages);
      continue;
    }
    for (uint32_t i = 0; i < cell.geometryPageCount; ++i) pages.insert(cell.firstGeometryPage + i);
  }
  return pageBytes(directory, pages);
}

}  // namespace farcell
