#include "preprocess/build/measure_job.h"

#include <algorithm>
#include <map>
#include <optional>

#include "cache/base/interrupt.h"
#include "preprocess/atlas/atlas.h"
#include "preprocess/atlas/atlas_sampler.h"
#include "preprocess/build/bake_job.h"
#include "preprocess/build/soup.h"
#include "preprocess/encode/view_image.h"
#include "preprocess/partition/grid_triangle.h"

namespace farcell {
namespace {

Result<CellSoup> soupOf(const SoupSource& source, uint32_t cell, const std::vector<uint32_t>& leaves) {
  CellSoup soup;
  for (const uint32_t leaf : leaves) FARCELL_TRY(source.append(cell, leaf, soup, [] { return checkInterrupt(); }));
  return soup;
}

// All levels of the atlas of a part of a mesh; nothing when it has none.
Result<std::optional<TexturePage>> storedAtlas(const BuildContext& context, uint32_t cell, uint32_t part) {
  std::vector<TexturePage> pages;
  for (const uint32_t group : context.store.textureGroups(cell)) {
    if (group / kAtlasGroups != part) continue;
    FARCELL_ASSIGN(const CodedPart coded, context.store.texture(cell, group));
    FARCELL_ASSIGN(TexturePage page, decodeTexturePage(coded.bytes, {coded.decodedBytes}));
    pages.push_back(std::move(page));
  }
  if (pages.empty()) return std::optional<TexturePage>{};
  FARCELL_ASSIGN(TexturePage atlas, atlasOfPages(pages));
  return std::optional<TexturePage>{std::move(atlas)};
}

// What the corners of a part look at: the atlas of this number, or none.
void appendCoordinates(const GeometryPage& page, uint32_t atlas, CellSoup& soup) {
  soup.textures.insert(soup.textures.end(), page.indices.size() / 3, atlas);
  for (size_t i = 0; i < page.indices.size(); ++i) {
    const glm::vec2 at =
        page.coordinates.empty() ? glm::vec2(0) : unpackedCoordinates(page.coordinates[page.indices[i]]);
    soup.u[i % 3].push_back(at.x);
    soup.v[i % 3].push_back(at.y);
  }
}

// The mesh as the pack has it; its textures are indices into `atlases`.
Result<CellSoup> meshSoup(const BuildContext& context, uint32_t cell, std::vector<TexturePage>& atlases) {
  const GridBox cube = cellBox(context.model.grid, context.tree.cells[cell].key);
  const auto side = static_cast<uint32_t>(cube.max.x - cube.min.x);
  CellSoup soup;
  const bool textured = !context.store.textureGroups(cell).empty();
  const uint32_t parts = context.store.meshFigures(cell).parts;
  for (uint32_t part = 0; part < parts; ++part) {
    FARCELL_ASSIGN(const CodedPart coded, context.store.part(cell, part));
    FARCELL_ASSIGN(const GeometryPage page, decodeGeometryPage(coded.bytes, {side, coded.decodedBytes}));
    if (textured) {
      FARCELL_ASSIGN(std::optional<TexturePage> atlas, storedAtlas(context, cell, part));
      appendCoordinates(page, atlas ? static_cast<uint32_t>(atlases.size()) : kNoTexture, soup);
      if (atlas) atlases.push_back(*std::move(atlas));
    }
    const auto& [red, green, blue] = kDefaultAlbedo;
    const uint32_t lit = packNormal(sunDirection(context.model.settings.up, context.model.settings.sun));
    const uint32_t plain = red | uint32_t{green} << 8 | uint32_t{blue} << 16;
    for (size_t i = 0; i < page.indices.size(); ++i) {
      const uint32_t vertex = page.indices[i];
      const glm::dvec3 local = glm::dvec3(page.positions[vertex]) * (2.0 / side) - 1.0;
      soup.x[i % 3].push_back(static_cast<float>(local.x));
      soup.y[i % 3].push_back(static_cast<float>(local.y));
      soup.z[i % 3].push_back(static_cast<float>(local.z));
      soup.colours[i % 3].push_back(!page.shown.empty()    ? page.shown[i / 3]
                                    : page.colours.empty() ? plain
                                                           : page.colours[vertex]);
      if (!page.shown.empty())
        soup.normals[i % 3].push_back(lit);  // fully lit
      else if (!page.normals.empty())
        soup.normals[i % 3].push_back(page.normals[vertex]);
    }
  }
  return soup;
}

LocalBox contentOf(const BuildContext& context, const CellRecord& cell) {
  const GridBox cube = cellBox(context.model.grid, cell.key);
  const glm::dvec3 centre = glm::dvec3(cube.min + cube.max) * 0.5;
  const double half = 0.5 * (cube.max.x - cube.min.x);
  return {glm::vec3((glm::dvec3(cell.content.min) - centre) / half),
          glm::vec3((glm::dvec3(cell.content.max) - centre) / half)};
}

constexpr const char* kMeasuring = "measuring a cell";

// Three soups; the finest picture's samples, and a few pictures with views as images and as floats.
uint64_t bytesOfMeasuring(const BuildContext& context, uint32_t cell) {
  const uint64_t triangles = context.tree.cells[cell].triangles;
  constexpr uint64_t kEdge = kMaxMeasuredEdge;
  constexpr uint64_t kMeasuredViews = 3 * 2 * 3 * kCandidateViews.size();  // that are held at once, at most
  const uint64_t triangle = 4 * (12 + (context.model.hasNormals ? 3 : 0) + (context.hasTextures ? 7 : 0));
  const uint64_t samples = std::max(16, context.model.settings.samples);
  return (context.hasTextures ? kAtlasBytes : 0) + 5 * triangles * triangle +
         kEdge * kEdge * (16 * samples + 40 + 8 * 16) + kMeasuredViews * kEdge * kEdge / 4;
}

// The views of a cell as its pack will hold them; those that visitors never get are baked now.
class StoredViews {
 public:
  StoredViews(const BuildContext& context, uint32_t cell, const CellSoup& grown, TextureSampler* textures)
      : context_(context), cell_(cell), grown_(grown), textures_(textures) {}

  Result<> load() {
    FARCELL_ASSIGN(views_, context_.store.views(cell_));
    return {};
  }

  Result<ViewImage> operator()(int view) const {
    if (!context_.wanted(cell_, view)) return baked(view);
    const auto number = static_cast<uint32_t>(view);
    const auto found = std::find_if(views_.begin(), views_.end(), [&](const auto& v) { return v.view == number; });
    if (found == views_.end()) return ViewImage{.view = number, .rgba = {}, .depth = {}, .normal = {}};
    const std::vector<std::byte> page = viewPageOf(std::span(&*found, 1)).bytes;
    FARCELL_ASSIGN(ViewPage decoded, decodeViewPage(page, viewLimitsOf(context_.form(cell_), UINT64_MAX)));
    return std::move(decoded.views.at(0));
  }

 private:
  ViewImage baked(int view) const {
    const BuildSettings& settings = context_.model.settings;
    const int imageSize = context_.form(cell_).imageSize;
    ViewBaker baker({imageSize, settings.samples, sunDirection(settings.up, settings.sun),
                     settings.lighting == Lighting::relightable},
                    textures_);
    BakedView front, back;
    baker.begin(viewFrame(context_.viewpoints(cell_).directions()[static_cast<size_t>(view)]));
    baker.add(grown_);
    baker.finish(front, back);
    return quantisedView(front, static_cast<uint32_t>(view), imageSize);
  }

  const BuildContext& context_;
  const uint32_t cell_;
  const CellSoup& grown_;
  TextureSampler* const textures_;
  std::vector<EncodedView> views_;
};

struct Triangles {
  CellSoup grown, alone;
};

Result<Triangles> trianglesOf(const BuildContext& context, uint32_t cell) {
  const SoupSource source(context.model, context.tree, context.partition);
  FARCELL_ASSIGN(CellSoup grown, soupOf(source, cell, source.leavesInside(cell)));
  FARCELL_ASSIGN(CellSoup alone, soupOf(source, cell, source.leavesBelow(cell)));
  return Triangles{std::move(grown), std::move(alone)};
}

// By level, then triangles: those that have views and are not too large.
std::vector<uint32_t> measurable(const CellTree& tree) {
  const auto& cells = tree.cells;
  std::vector<uint32_t> eligible;
  for (uint32_t cell = 0; cell < cells.size(); ++cell)
    if (isBaked(cells[cell]) && cells[cell].triangles <= kMaxMeasuredTriangles) eligible.push_back(cell);
  std::stable_sort(eligible.begin(), eligible.end(), [&](uint32_t a, uint32_t b) {
    if (cells[a].key.level != cells[b].key.level) return cells[a].key.level < cells[b].key.level;
    return cells[a].triangles < cells[b].triangles;
  });
  return eligible;
}

// Evenly.
std::vector<uint32_t> spread(const std::vector<uint32_t>& cells, size_t count) {
  std::vector<uint32_t> some;
  for (size_t i = 0; i < count; ++i) some.push_back(cells[(2 * i + 1) * cells.size() / (2 * count)]);
  return some;
}

MeasureSettings settingsOf(const BuildContext& context, uint32_t cell) {
  const BuildSettings& settings = context.model.settings;
  return {context.viewpoints(cell), context.form(cell).imageSize,
          settings.samples,         sunDirection(settings.up, settings.sun),
          settings.lighting,        settings.viewError};
}

}  // namespace

std::vector<uint32_t> cellsToMeasure(const CellTree& tree, Measure measure) {
  std::vector<uint32_t> eligible = measurable(tree);
  const size_t cells = tree.cells.size();
  const size_t sample = std::clamp(cells / 50, std::min(kUsuallyMeasured, cells / 4), kMostMeasured);
  const size_t wanted = measure == Measure::all ? eligible.size() : std::max(sample, kLeastMeasured);
  return spread(eligible, std::min(eligible.size(), wanted));
}

std::vector<uint32_t> cellsOfCandidates(const CellTree& tree) {
  std::map<FormKind, std::vector<uint32_t>> kinds;
  for (const uint32_t cell : measurable(tree)) kinds[kindOf(tree.cells[cell])].push_back(cell);
  std::vector<uint32_t> result;
  for (const auto& [kind, cells] : kinds) {
    const size_t count = std::clamp(cells.size() / 50, std::min(cells.size(), kLeastCandidates), kMostCandidates);
    for (const uint32_t cell : spread(cells, count)) result.push_back(cell);
  }
  return result;
}

Result<> measureStored(const BuildContext& context, uint32_t cell, TextureSampler* textures) {
  FARCELL_TRY(checkInterrupt());
  FARCELL_ASSIGN(const MemoryGate::Share share, context.gate.take(bytesOfMeasuring(context, cell), kMeasuring));
  const Lap lap(context.clock.measureNs);
  FARCELL_ASSIGN(const Triangles triangles, trianglesOf(context, cell));
  std::vector<TexturePage> atlases;
  FARCELL_ASSIGN(const CellSoup mesh, meshSoup(context, cell, atlases));
  AtlasSampler meshTextures(std::move(atlases));
  StoredViews views(context, cell, triangles.grown, textures);
  FARCELL_TRY(views.load());
  const MeasuredCell what{contentOf(context, context.tree.cells[cell]),
                          triangles.alone,
                          triangles.grown,
                          mesh.size() > 0 ? &mesh : nullptr,
                          textures,
                          &meshTextures};
  FARCELL_ASSIGN(const CellErrors errors, measureCell(
                                              what, [&](int view) { return views(view); }, settingsOf(context, cell)));
  if (textures != nullptr && textures->failure()) return tl::unexpected<Error>(*textures->failure());
  return context.store.addErrors(cell, errors);
}

Result<> measureForms(const BuildContext& context, uint32_t cell, TextureSampler* textures) {
  FARCELL_TRY(checkInterrupt());
  FARCELL_ASSIGN(const MemoryGate::Share share, context.gate.take(bytesOfMeasuring(context, cell), kMeasuring));
  const Lap lap(context.clock.measureNs);
  FARCELL_ASSIGN(const Triangles triangles, trianglesOf(context, cell));
  const MeasuredCell what{
      contentOf(context, context.tree.cells[cell]), triangles.alone, triangles.grown, nullptr, textures, nullptr};
  FARCELL_ASSIGN(const CellCandidates candidates, measureCandidates(what, settingsOf(context, cell)));
  if (textures != nullptr && textures->failure()) return tl::unexpected<Error>(*textures->failure());
  return context.store.addCandidates(cell, candidates);
}

std::vector<ViewFigures> viewFigures(size_t cells, std::span<const ViewCost> costs) {
  std::vector<ViewFigures> figures(cells);
  for (const ViewCost& cost : costs) {
    if (cost.texels == 0) continue;
    ViewFigures& cell = figures[cost.cell];
    ++cell.views;
    cell.bytes += cost.bytes;
    cell.coveredTexels += cost.covered;
    cell.edgeTexels += cost.edges;
  }
  for (ViewFigures& cell : figures) {
    if (cell.views == 0) continue;
    cell.bytes /= cell.views;
    cell.coveredTexels /= cell.views;
    cell.edgeTexels /= cell.views;
  }
  return figures;
}

}  // namespace farcell
