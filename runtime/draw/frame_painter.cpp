#include "runtime/draw/frame_painter.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <set>

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

// Parts of a page may have finer texels than it has on average.
constexpr double kFinerThanMean = 1.5;

constexpr std::array<const char*, 4> kLookDefines = {"", "SHOW_TINT", "SHOW_DEPTH", "SHOW_NORMALS"};

glm::vec3 rgb(const std::array<uint8_t, 4>& colour) { return glm::vec3(colour[0], colour[1], colour[2]) / 255.0f; }

// One for each size of images, with equal parts of the budget.
std::map<int, ViewStore> viewStores(const Directory& directory, uint64_t budgetBytes) {
  std::set<int> sizes;
  for (const CellRecord& cell : directory.cells)
    if (cell.viewPageCount > 0) sizes.insert(cell.form.imageSize);
  std::map<int, ViewStore> stores;
  for (const int size : sizes)
    stores.try_emplace(size, size, budgetBytes / sizes.size(),
                       directory.model.settings.lighting == Lighting::relightable);
  return stores;
}

// Which views draw an impostor; kind B's are in order of weight.
ImpostorViews viewsOf(const CutEntry& entry, ImpostorKind kind) {
  ImpostorViews views;
  views[0].index = entry.view;
  if (kind == ImpostorKind::depthCorrected) views[1].index = entry.secondView;
  if (kind == ImpostorKind::blended)
    for (size_t i = 0; i < views.size(); ++i) {
      views[i].index = static_cast<uint32_t>(entry.blend.views[i]);
      views[i].weight = entry.blend.weights[i];
    }
  return views;
}

// Empty views, and those left out of the pack, have no say: the others keep their proportions.
void shareWeights(ImpostorViews& views) {
  std::stable_partition(views.begin(), views.end(), [](const DirectedView& view) { return view.view.layer >= 0; });
  double sum = 0;
  for (const DirectedView& view : views) sum += view.view.layer >= 0 ? view.weight : 0;
  for (DirectedView& view : views) view.weight = view.view.layer >= 0 && sum > 0 ? view.weight / sum : 0;
}

}  // namespace

Result<FramePainter> FramePainter::create(const PackFile& pack, uint64_t residentBytes) {
  FramePainter painter(pack, residentBytes);
  FARCELL_TRY(painter.prepare(Look::picture));
  return painter;
}

FramePainter::FramePainter(const PackFile& pack, uint64_t residentBytes)
    : pack_(pack),
      textured_(std::any_of(pack.directory().cells.begin(), pack.directory().cells.end(),
                            [](const CellRecord& cell) { return cell.texturePageCount > 0; })),
      geometry_(textured_ ? residentBytes / 4 : residentBytes / 2, textured_),
      atlases_(residentBytes / 4),
      views_(viewStores(pack.directory(), residentBytes / 2)),
      uniforms_(createBuffer()),
      instances_(createBuffer()),
      corners_(createBuffer()),
      bare_(createVertexArray()) {
  glNamedBufferStorage(uniforms_.name(), sizeof(shared::FrameUniforms), nullptr, GL_DYNAMIC_STORAGE_BIT);
  glNamedBufferStorage(corners_.name(), sizeof(kCorners), kCorners.data(), 0);
  glVertexArrayElementBuffer(bare_.name(), corners_.name());
}

Result<FramePainter::Programs> FramePainter::loadPrograms(Look look) const {
  const Model& model = pack_.directory().model;
  std::vector<std::string> defines;
  if (look != Look::picture) defines = {"SHOW", kLookDefines[static_cast<size_t>(look)]};
  std::vector<std::string> triangleDefines = defines;
  if (model.hasNormals) triangleDefines.push_back("SMOOTH_NORMALS");
  if (model.hasSides) triangleDefines.push_back("SIDES");
  if (model.settings.lighting == Lighting::relightable) defines.push_back("RELIGHTABLE");
  Programs programs;
  for (const bool shared : {false, true})
    for (const bool textured : {false, true}) {
      if (textured && !textured_) continue;
      std::vector<std::string> some = triangleDefines;
      if (shared) some.push_back("SHARES");
      if (textured) some.push_back("TEXTURED");
      FARCELL_ASSIGN(programs.triangles[trianglesOf(shared, textured)],
                     loadProgram({"shaders/gl/triangles.vert", "shaders/gl/triangles.frag", some}));
    }
  FARCELL_ASSIGN(programs.flat,
                 loadProgram({"shaders/gl/impostor_flat.vert", "shaders/gl/impostor_flat.frag", defines}));
  std::vector<std::string> marchDefines = defines;
  marchDefines.push_back("VIEWS 2");
  FARCELL_ASSIGN(programs.depthCorrected,
                 loadProgram({"shaders/gl/impostor.vert", "shaders/gl/impostor.frag", marchDefines}));
  marchDefines.back() = "VIEWS 3";
  FARCELL_ASSIGN(programs.blended, loadProgram({"shaders/gl/impostor.vert", "shaders/gl/impostor.frag", marchDefines}));
  return programs;
}

Result<> FramePainter::prepare(Look look) {
  std::optional<Programs>& programs = programs_[static_cast<size_t>(look)];
  if (programs) return {};
  FARCELL_ASSIGN(programs, loadPrograms(look));
  return {};
}

Result<> FramePainter::paint(const Cut& cut, const FrameCamera& camera, ImpostorKind kind, const ShowPlan& plan,
                             PaintCounts& counts) {
  FARCELL_TRY(prepare(plan.look));
  Frame frame{cut, camera, kind, plan, *programs_[static_cast<size_t>(plan.look)], counts, {}};
  shared::FrameUniforms uniforms = camera.uniforms;
  uniforms.depthScale = plan.depthScale;
  glNamedBufferSubData(uniforms_.name(), 0, sizeof(uniforms), &uniforms);
  glBindBufferBase(GL_UNIFORM_BUFFER, 0, uniforms_.name());
  glClipControl(GL_LOWER_LEFT, GL_ZERO_TO_ONE);
  glEnable(GL_DEPTH_TEST);
  glDepthFunc(GL_GEQUAL);  // reversed: larger is nearer
  FARCELL_TRY(paintTriangles(frame));
  FARCELL_TRY(paintImpostors(frame));
  return paintLines(frame);
}

Result<> FramePainter::paintTriangles(const Frame& frame) {
  glDisable(GL_BLEND);
  glDisable(GL_CULL_FACE);
  glDepthMask(GL_TRUE);
  Portions portions;
  geometry_.beginPortion();
  atlases_.beginPortion();
  for (size_t i = 0; i < frame.cut.entries.size(); ++i) {
    const CutEntry& entry = frame.cut.entries[i];
    const CellRecord& cell = pack_.directory().cells[entry.cell];
    if (entry.representation == Representation::impostor) continue;
    GeometryStore::Tint tint{};
    if (!frame.plan.tints.empty()) tint = frame.plan.tints[i];
    tint[3] = entry.shares;
    for (uint32_t part = 0; part < cell.geometryPageCount; ++part) {
      const uint32_t index = cell.firstGeometryPage + part;
      FARCELL_TRY(addPage(index, frame, portions));
      const auto atlas = pack_.atlasPages(entry.cell, part);
      if (!atlas.empty()) FARCELL_TRY(addAtlas(index, cell, frame, portions));
      const bool shared = entry.shares != kAllShares;
      Portion& portion = portions[trianglesOf(shared, !atlas.empty())];
      portion.pages.push_back(index);
      if (!atlas.empty()) portion.atlases.push_back(numberOf(atlas));
      if (shared || !frame.plan.tints.empty()) portion.tints.push_back(tint);
    }
  }
  drawPortions(frame, portions);
  return {};
}

// Makes it resident; where there is no room, what there is so far is drawn and leaves.
Result<> FramePainter::addPage(uint32_t index, const Frame& frame, Portions& portions) {
  if (geometry_.keep(index)) return {};
  const Directory& directory = pack_.directory();
  FARCELL_ASSIGN(const GeometryPage page, pack_.readGeometry(index));
  frame.counts.bytesRead += directory.pages[index].storedBytes;
  const CellRecord& cell = directory.cells[directory.pages[index].cell];
  if (!page.coordinates.empty()) atlasEdgesPerStep_[index] = atlasEdgesPerStep(page);
  const GpuMesh mesh = makeGpuMesh(page, cellBox(directory.model.grid, cell.key).min);
  if (geometry_.add(index, mesh)) return {};
  drawPortions(frame, portions);
  geometry_.beginPortion();
  FARCELL_CHECK(geometry_.add(index, mesh));
  return {};
}

// The atlas of a resident page, likewise; then as fine as the page needs it from here and there is room for.
Result<> FramePainter::addAtlas(uint32_t page, const CellRecord& cell, const Frame& frame, Portions& portions) {
  const PageRecord& record = pack_.directory().pages[page];
  const uint32_t number = numberOf(pack_.atlasPages(record.cell, record.group));
  if (atlases_.keep(number) == nullptr) {
    FARCELL_ASSIGN(const TexturePage coarse, readAtlasPage(number, frame.counts));
    if (atlases_.add(number, coarse) == nullptr) {
      drawPortions(frame, portions);
      geometry_.beginPortion();
      atlases_.beginPortion();
      FARCELL_CHECK(geometry_.keep(page) && atlases_.add(number, coarse) != nullptr);
    }
  }
  return refineAtlas(page, cell, frame);
}

Result<> FramePainter::refineAtlas(uint32_t page, const CellRecord& cell, const Frame& frame) {
  const PageRecord& record = pack_.directory().pages[page];
  const std::span<const PageRecord> pages = pack_.atlasPages(record.cell, record.group);
  const uint32_t number = numberOf(pages);
  const AtlasStore::Resident& resident = *atlases_.keep(number);
  const uint32_t level = atlases_.finestLevel(number, wantedLevel(page, cell, frame, resident.shape));
  if (level >= resident.firstLevel) return {};
  // Each page after the first holds the level before.
  const uint32_t coarse = firstCoarseLevel(resident.shape);
  std::vector<TexturePage> finer;
  for (uint32_t next = resident.firstLevel; next-- > level;) {
    const uint32_t group = coarse - next;
    if (group >= pages.size())
      return fail(ErrorKind::corrupt, "{}: page {}: expected an atlas with level {}", pack_.path(), number, next);
    FARCELL_ASSIGN(TexturePage read, readAtlasPage(number + group, frame.counts));
    if (read.width != resident.shape.width || read.height != resident.shape.height ||
        read.channels != resident.shape.channels || read.firstLevel != next)
      return fail(ErrorKind::corrupt, "{}: page {}: expected level {} of the atlas of page {}", pack_.path(),
                  number + group, next, number);
    finer.push_back(std::move(read));
  }
  atlases_.refine(number, finer);
  return {};
}

// By the nearest point of what the cell holds.
uint32_t FramePainter::wantedLevel(uint32_t page, const CellRecord& cell, const Frame& frame,
                                   const TexturePage& atlas) const {
  glm::dvec3 away;
  for (int axis = 0; axis < 3; ++axis)
    away[axis] = std::max({cell.content.min[axis] - frame.camera.eyeSteps[axis],
                           frame.camera.eyeSteps[axis] - cell.content.max[axis], 0.0});
  const double pixelSteps = glm::length(away) * frame.camera.pixelAngle;
  const double texelsPerStep = atlasEdgesPerStep_.at(page) * std::sqrt(static_cast<double>(atlas.width) * atlas.height);
  double texelsPerPixel = pixelSteps * texelsPerStep / kFinerThanMean;
  uint32_t level = 0;
  for (; level + 1 < atlas.levelCount && texelsPerPixel >= 2; texelsPerPixel /= 2) ++level;
  return level;
}

Result<TexturePage> FramePainter::readAtlasPage(uint32_t page, PaintCounts& counts) const {
  counts.bytesRead += pack_.directory().pages[page].storedBytes;
  return pack_.readTexture(page);
}

uint32_t FramePainter::numberOf(std::span<const PageRecord> atlas) const {
  return static_cast<uint32_t>(atlas.data() - pack_.directory().pages.data());
}

void FramePainter::drawPortions(const Frame& frame, Portions& portions) {
  for (size_t i = 0; i < portions.size(); ++i) {
    const Portion& portion = portions[i];
    if (portion.pages.empty()) continue;
    // Not before: an atlas that became finer is another texture.
    std::vector<GLuint> atlases;
    for (const uint32_t number : portion.atlases) atlases.push_back(atlases_.keep(number)->texture);
    glUseProgram(frame.programs.triangles[i].name());
    geometry_.draw(portion.pages, portion.tints, atlases);
  }
  portions = {};
}

Result<> FramePainter::paintImpostors(Frame& frame) {
  const Directory& directory = pack_.directory();
  // A run of impostors whose images are of one size: one draw.
  std::vector<shared::ImpostorInstance> run;
  int imageSize = 0;
  const auto draw = [&] {
    if (!run.empty()) drawImpostors(run, views_.at(imageSize), frame);
    run.clear();
  };
  const auto beginPortion = [&] {
    draw();
    for (auto& [size, store] : views_) store.beginPortion();
  };
  beginPortion();
  for (size_t i = frame.cut.entries.size(); i-- > 0;) {
    const CutEntry& entry = frame.cut.entries[i];
    if (entry.representation != Representation::impostor) continue;
    FARCELL_ASSIGN(std::optional<ImpostorViews> views, residentViews(entry, frame.kind, frame.counts));
    if (!views) {
      beginPortion();
      FARCELL_ASSIGN(views, residentViews(entry, frame.kind, frame.counts));
      FARCELL_CHECK(views.has_value());
    }
    if (std::all_of(views->begin(), views->end(), [](const DirectedView& view) { return view.view.layer < 0; }))
      continue;
    const CellRecord& cell = directory.cells[entry.cell];
    if (cell.form.imageSize != imageSize) draw();
    imageSize = cell.form.imageSize;
    run.push_back(makeImpostorInstance(directory.model, cell, *views, entry.shares, frame.camera));
    if (!frame.plan.tints.empty()) run.back().tint = glm::vec4(rgb(frame.plan.tints[i]), run.back().tint.w);
    if (frame.plan.show == Show::billboards)
      addBillboard(frame.lines, run.back(), lineColour(entry.representation, frame.kind));
    ++frame.counts.impostors;
    for (const DirectedView& view : *views) frame.counts.texels += uint64_t{view.view.width} * view.view.height;
  }
  draw();
  return {};
}

Result<> FramePainter::paintLines(Frame& frame) {
  const Directory& directory = pack_.directory();
  if (frame.plan.show == Show::cells)
    for (const CutEntry& entry : frame.cut.entries)
      addBox(frame.lines, cellBox(directory.model.grid, directory.cells[entry.cell].key), frame.camera.eyeSteps,
             lineColour(entry.representation, frame.kind));
  if (frame.lines.empty()) return {};
  if (!linePainter_) {
    FARCELL_ASSIGN(linePainter_, LinePainter::create());
  }
  linePainter_->paint(frame.lines);
  return {};
}

// Nothing when the views do not fit beside those of this portion.
Result<std::optional<ImpostorViews>> FramePainter::residentViews(const CutEntry& entry, ImpostorKind kind,
                                                                 PaintCounts& counts) {
  const ViewForm& form = pack_.directory().cells[entry.cell].form;
  ViewStore& store = views_.at(form.imageSize);
  ImpostorViews views = viewsOf(entry, kind);
  for (DirectedView& directed : views) {
    if (directed.index == kNone) continue;
    directed.direction = Viewpoints::of(form.views).directions()[directed.index];
    const ResidentView* resident = store.keep(entry.cell, directed.index);
    if (resident == nullptr) {
      FARCELL_ASSIGN(const ViewImage image, readView(entry.cell, directed.index, counts));
      resident = store.add(entry.cell, directed.index, image);
      if (resident == nullptr) return std::optional<ImpostorViews>{};
    }
    directed.view = *resident;
  }
  if (kind == ImpostorKind::blended) shareWeights(views);
  return std::optional<ImpostorViews>{views};
}

void FramePainter::drawImpostors(const std::vector<shared::ImpostorInstance>& instances, const ViewStore& views,
                                 const Frame& frame) {
  glNamedBufferData(instances_.name(), static_cast<GLsizeiptr>(instances.size() * sizeof(instances[0])),
                    instances.data(), GL_STREAM_DRAW);
  glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 0, instances_.name());
  views.bind();
  glEnable(GL_BLEND);
  glBlendFunc(GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
  glDepthMask(GL_FALSE);
  glBindVertexArray(bare_.name());
  const auto count = static_cast<GLsizei>(instances.size());
  if (frame.kind == ImpostorKind::flat) {
    glDisable(GL_CULL_FACE);
    glUseProgram(frame.programs.flat.name());
    glDrawElementsInstanced(GL_TRIANGLES, kRectangleIndices, GL_UNSIGNED_SHORT,
                            reinterpret_cast<const void*>(kBoxIndices * sizeof(uint16_t)), count);
  } else {
    glEnable(GL_CULL_FACE);
    glCullFace(GL_FRONT);
    glUseProgram(frame.kind == ImpostorKind::blended ? frame.programs.blended.name()
                                                     : frame.programs.depthCorrected.name());
    glDrawElementsInstanced(GL_TRIANGLES, kBoxIndices, GL_UNSIGNED_SHORT, nullptr, count);
  }
}

// A view that was left out of the pack is an empty image.
Result<ViewImage> FramePainter::readView(uint32_t cell, uint32_t view, PaintCounts& counts) const {
  const Directory& directory = pack_.directory();
  const CellRecord& record = directory.cells[cell];
  const auto group = static_cast<uint32_t>(Viewpoints::of(record.form.views).group(static_cast<int>(view)));
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
