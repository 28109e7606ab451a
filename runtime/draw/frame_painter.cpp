#include "runtime/draw/frame_painter.h"

#include <algorithm>
#include <array>

#include "cache/base/check.h"
#include "runtime/draw/gpu_mesh.h"
#include "runtime/draw/impostor_instance.h"

namespace farcell {
namespace {

// Corner bits 0, 1, 2 choose the high x, y, z; faces are counter-clockwise seen from outside.
constexpr std::array<uint16_t, 42> kCorners = {0, 4, 6, 0, 6, 2,   // low x
                                               1, 3, 7, 1, 7, 5,   // high x
                                               0, 1, 5, 0, 5, 4,   // low y
                                               2, 6, 7, 2, 7, 3,   // high y
                                               0, 2, 3, 0, 3, 1,   // low z
                                               4, 5, 7, 4, 7, 6,   // high z
                                               0, 1, 3, 0, 3, 2};  // a rectangle
constexpr GLsizei kBoxIndices = 36;
constexpr GLsizei kRectangleIndices = 6;

}  // namespace

Result<FramePainter> FramePainter::create(const PackFile& pack, const Viewpoints& viewpoints, uint64_t residentBytes) {
  std::vector<std::string> defines;
  if (pack.directory().model.hasNormals) defines.push_back("SMOOTH_NORMALS");
  Programs programs;
  FARCELL_ASSIGN(programs.triangles, loadProgram({"shaders/gl/triangles.vert", "shaders/gl/triangles.frag", defines}));
  FARCELL_ASSIGN(programs.flat, loadProgram({"shaders/gl/impostor_flat.vert", "shaders/gl/impostor_flat.frag", {}}));
  FARCELL_ASSIGN(programs.depthCorrected, loadProgram({"shaders/gl/impostor.vert", "shaders/gl/impostor.frag", {}}));
  return FramePainter(pack, viewpoints, residentBytes, std::move(programs));
}

FramePainter::FramePainter(const PackFile& pack, const Viewpoints& viewpoints, uint64_t residentBytes,
                           Programs programs)
    : pack_(pack),
      viewpoints_(viewpoints),
      programs_(std::move(programs)),
      geometry_(residentBytes / 2),
      views_(pack.directory().model.settings.imageSize, residentBytes / 2),
      uniforms_(createBuffer()),
      instances_(createBuffer()),
      corners_(createBuffer()),
      bare_(createVertexArray()) {
  glNamedBufferStorage(uniforms_.name(), sizeof(shared::FrameUniforms), nullptr, GL_DYNAMIC_STORAGE_BIT);
  glNamedBufferStorage(corners_.name(), sizeof(kCorners), kCorners.data(), 0);
  glVertexArrayElementBuffer(bare_.name(), corners_.name());
}

Result<> FramePainter::paint(const Cut& cut, const FrameCamera& camera, ImpostorKind kind, PaintCounts& counts) {
  glNamedBufferSubData(uniforms_.name(), 0, sizeof(camera.uniforms), &camera.uniforms);
  glBindBufferBase(GL_UNIFORM_BUFFER, 0, uniforms_.name());
  glClipControl(GL_LOWER_LEFT, GL_ZERO_TO_ONE);
  glEnable(GL_DEPTH_TEST);
  glDepthFunc(GL_GEQUAL);  // reversed: larger is nearer
  FARCELL_TRY(paintTriangles(cut, counts));
  return paintImpostors(cut, camera, kind, counts);
}

Result<> FramePainter::paintTriangles(const Cut& cut, PaintCounts& counts) {
  glDisable(GL_BLEND);
  glDisable(GL_CULL_FACE);
  glDepthMask(GL_TRUE);
  glUseProgram(programs_.triangles.name());
  const Directory& directory = pack_.directory();
  std::vector<uint32_t> portion;
  geometry_.beginPortion();
  for (const CutEntry& entry : cut.entries) {
    const CellRecord& cell = directory.cells[entry.cell];
    if (entry.representation != Representation::triangles || cell.geometryPage == kNone) continue;
    if (!geometry_.keep(entry.cell)) {
      FARCELL_ASSIGN(const GeometryPage page, pack_.readGeometry(cell.geometryPage));
      counts.bytesRead += directory.pages[cell.geometryPage].storedBytes;
      if (page.indices.empty()) continue;
      const GpuMesh mesh = makeGpuMesh(page, cellBox(directory.model.grid, cell.key).min);
      if (!geometry_.add(entry.cell, mesh)) {
        geometry_.draw(portion);
        portion.clear();
        geometry_.beginPortion();
        FARCELL_CHECK(geometry_.add(entry.cell, mesh));
      }
    }
    portion.push_back(entry.cell);
  }
  geometry_.draw(portion);
  return {};
}

Result<> FramePainter::paintImpostors(const Cut& cut, const FrameCamera& camera, ImpostorKind kind,
                                      PaintCounts& counts) {
  const Directory& directory = pack_.directory();
  std::vector<shared::ImpostorInstance> portion;
  views_.beginPortion();
  for (size_t i = cut.entries.size(); i-- > 0;) {
    const CutEntry& entry = cut.entries[i];
    if (entry.representation != Representation::impostor) continue;
    FARCELL_ASSIGN(std::optional<ViewPair> pair, residentPair(entry, kind, counts));
    if (!pair) {
      drawImpostors(portion, kind);
      portion.clear();
      views_.beginPortion();
      FARCELL_ASSIGN(pair, residentPair(entry, kind, counts));
      FARCELL_CHECK(pair.has_value());
    }
    const auto& [nearest, second] = *pair;
    if (nearest.view.layer < 0 && second.view.layer < 0) continue;
    portion.push_back(makeImpostorInstance(directory.model, directory.cells[entry.cell], nearest, second, camera));
    ++counts.impostors;
    counts.texels += uint64_t{nearest.view.width} * nearest.view.height;
    counts.texels += uint64_t{second.view.width} * second.view.height;
  }
  drawImpostors(portion, kind);
  return {};
}

// Nothing when the views do not fit beside those of this portion.
Result<std::optional<FramePainter::ViewPair>> FramePainter::residentPair(const CutEntry& entry, ImpostorKind kind,
                                                                         PaintCounts& counts) {
  ViewPair pair;
  for (const auto& [view, place] : {std::pair{entry.view, &pair.nearest}, std::pair{entry.secondView, &pair.second}}) {
    place->direction = viewpoints_.directions()[view];
    if (kind == ImpostorKind::flat && place == &pair.second) continue;
    const ResidentView* resident = views_.keep(entry.cell, view);
    if (resident == nullptr) {
      FARCELL_ASSIGN(const ViewImage image, readView(entry.cell, view, counts));
      resident = views_.add(entry.cell, view, image);
      if (resident == nullptr) return std::optional<ViewPair>{};
    }
    place->view = *resident;
  }
  return std::optional<ViewPair>{pair};
}

void FramePainter::drawImpostors(const std::vector<shared::ImpostorInstance>& instances, ImpostorKind kind) {
  if (instances.empty()) return;
  glNamedBufferData(instances_.name(), static_cast<GLsizeiptr>(instances.size() * sizeof(instances[0])),
                    instances.data(), GL_STREAM_DRAW);
  glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 0, instances_.name());
  views_.bind();
  glEnable(GL_BLEND);
  glBlendFunc(GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
  glDepthMask(GL_FALSE);
  glBindVertexArray(bare_.name());
  const auto count = static_cast<GLsizei>(instances.size());
  if (kind == ImpostorKind::flat) {
    glDisable(GL_CULL_FACE);
    glUseProgram(programs_.flat.name());
    glDrawElementsInstanced(GL_TRIANGLES, kRectangleIndices, GL_UNSIGNED_SHORT,
                            reinterpret_cast<const void*>(kBoxIndices * sizeof(uint16_t)), count);
  } else {
    glEnable(GL_CULL_FACE);
    glCullFace(GL_FRONT);
    glUseProgram(programs_.depthCorrected.name());
    glDrawElementsInstanced(GL_TRIANGLES, kBoxIndices, GL_UNSIGNED_SHORT, nullptr, count);
  }
}

// A view that was left out of the pack is an empty image.
Result<ViewImage> FramePainter::readView(uint32_t cell, uint32_t view, PaintCounts& counts) const {
  const Directory& directory = pack_.directory();
  const CellRecord& record = directory.cells[cell];
  const auto group = static_cast<uint32_t>(viewpoints_.group(static_cast<int>(view)));
  for (uint32_t page = record.firstViewPage; page < record.firstViewPage + record.viewPageCount; ++page) {
    if (directory.pages[page].group != group) continue;
    FARCELL_ASSIGN(ViewPage content, pack_.readViews(page));
    counts.bytesRead += directory.pages[page].storedBytes;
    for (ViewImage& image : content.views)
      if (image.view == view) return std::move(image);
  }
  return ViewImage{.view = view, .rgba = {}, .depth = {}, .normal = {}};
}

}  // namespace farcell
