#include "preprocess/build/mesh_job.h"

#include <algorithm>
#include <map>
#include <optional>

#include "cache/base/interrupt.h"
#include "preprocess/atlas/atlas.h"
#include "preprocess/encode/geometry_page.h"
#include "preprocess/encode/vertex_colours.h"
#include "preprocess/lod/simplify_cell.h"

namespace farcell {
namespace {

// While a part is coded: its triangles, their corners being found again, the page in two orders, and its bytes.
constexpr uint64_t kBytesOfCodedTriangle = 500;

// Triangles of a list in portions of exactly kPartTriangles, but for the last.
class Parts {
 public:
  using Sink = std::function<Result<>(GridTriangles&&)>;
  explicit Parts(Sink sink) : sink_(std::move(sink)) {}

  Result<> add(const GridTriangleSpan& portion) {
    for (size_t i = 0; i < portion.size(); ++i) {
      part_.add(portion.triangles[i], portion.texture(i));
      if (part_.size() == kPartTriangles) FARCELL_TRY(flush());
    }
    return {};
  }
  Result<> flush() {
    if (part_.size() == 0) return {};
    GridTriangles full;
    std::swap(full, part_);
    return sink_(std::move(full));
  }

 private:
  Sink sink_;
  GridTriangles part_;
};

// Codes the parts of a mesh and stores each as soon as it is done: some meshes are larger than memory.
class MeshWriter {
 public:
  MeshWriter(CellStore& store, uint32_t cell) : store_(store), cell_(cell) {}

  Result<> add(const GeometryPage& page) {
    const GeometryPage ordered = optimisedOrder(page);
    const CodedPart coded{decodedSizeBytes(ordered), encodeGeometryPage(ordered)};
    bytes_ += coded.bytes.size();
    return store_.add(cell_, parts_++, coded);
  }
  // The next part is `page`, with this atlas; `coloured` is the same without it.
  Result<> add(const GeometryPage& page, const TexturePage& atlas, const GeometryPage& coloured) {
    const GeometryPage ordered = optimisedOrder(coloured);
    FARCELL_TRY(store_.addColoured(cell_, parts_, {decodedSizeBytes(ordered), encodeGeometryPage(ordered)}));
    uint32_t group = parts_ * kAtlasGroups;
    for (const TexturePage& texture : pagesOfAtlas(atlas)) {
      const CodedPart coded{decodedSizeBytes(texture), encodeTexturePage(texture)};
      bytes_ += coded.bytes.size();
      FARCELL_TRY(store_.addTexture(cell_, group++, coded));
    }
    return add(page);
  }
  Result<> finish(uint64_t triangles, double errorSteps) {
    return store_.add(cell_,
                      {triangles, errorSteps, parts_, static_cast<uint32_t>(std::min<uint64_t>(bytes_, UINT32_MAX))});
  }

 private:
  CellStore& store_;
  const uint32_t cell_;
  uint32_t parts_ = 0;
  uint64_t bytes_ = 0;
};

// Marks the triangles that are seen from their front only.
void markSides(GridTriangles& part, const TextureSampler& textures) {
  for (size_t i = 0; i < part.textures.size(); ++i) {
    const uint32_t texture = part.textures[i].texture;
    if (texture == kNoTexture || textures.surface(texture).doubleSided) continue;
    for (uint32_t& colour : part.triangles[i].colours) colour |= kSeenFromFront;
  }
}

// ---- inner cells ----

// Welded, with quadrics, its edges and the trees by which distances are measured.
constexpr uint64_t kBytesOfSimplifiedTriangle = 600;

Result<LodMesh> storedMesh(const BuildContext& context, uint32_t cell) {
  const CellKey& key = context.tree.cells[cell].key;
  const GridPoint cellMin = cellBox(context.model.grid, key).min;
  const uint32_t maxCoordinate = 1u << (context.model.grid.bits - static_cast<int>(key.level));
  LodMesh mesh;
  const uint32_t parts = context.store.meshFigures(cell).parts;
  for (uint32_t part = 0; part < parts; ++part) {
    FARCELL_ASSIGN(const CodedPart coded, context.store.coloured(cell, part));
    FARCELL_ASSIGN(const GeometryPage page, decodeGeometryPage(coded.bytes, {maxCoordinate, coded.decodedBytes}));
    const auto first = static_cast<uint32_t>(mesh.positions.size());
    for (const glm::uvec3& position : page.positions) mesh.positions.push_back(cellMin + GridPoint(position));
    for (const uint32_t index : page.indices) mesh.indices.push_back(first + index);
    for (const uint32_t colour : page.colours) mesh.colours.push_back(colour & ~kSeenFromFront);
    mesh.normals.insert(mesh.normals.end(), page.normals.begin(), page.normals.end());
    mesh.shown.insert(mesh.shown.end(), page.shown.begin(), page.shown.end());
  }
  return mesh;
}

// Triangles [first, first + count) with the vertices that they use.
GeometryPage pageOf(const LodMesh& mesh, size_t first, size_t count, GridPoint cellMin) {
  GeometryPage page;
  std::vector<uint32_t> numbers(mesh.positions.size(), UINT32_MAX);
  for (size_t i = 3 * first; i < 3 * (first + count); ++i) {
    const uint32_t vertex = mesh.indices[i];
    if (numbers[vertex] == UINT32_MAX) {
      numbers[vertex] = static_cast<uint32_t>(page.positions.size());
      page.positions.push_back(glm::uvec3(mesh.positions[vertex] - cellMin));
      if (!mesh.colours.empty()) page.colours.push_back(mesh.colours[vertex]);
      if (!mesh.normals.empty()) page.normals.push_back(mesh.normals[vertex]);
    }
    page.indices.push_back(numbers[vertex]);
  }
  if (!mesh.shown.empty())
    page.shown.assign(mesh.shown.begin() + static_cast<ptrdiff_t>(first),
                      mesh.shown.begin() + static_cast<ptrdiff_t>(first + count));
  return page;
}

struct Children {
  uint64_t triangles = 0;
  double errorSteps = 0;
  bool whole = true;  // all have a mesh of what they hold
};

Children childrenOf(const BuildContext& context, const CellRecord& cell) {
  Children children;
  for (uint32_t child = cell.firstChild; child < cell.firstChild + cell.childCount; ++child) {
    const MeshFigures mesh = context.store.meshFigures(child);
    children.triangles += mesh.triangles;
    children.errorSteps = std::max(children.errorSteps, mesh.errorSteps);
    children.whole = children.whole && (mesh.triangles > 0 || context.tree.cells[child].triangles == 0);
  }
  return children;
}

}  // namespace

Result<> codeLeaf(const BuildContext& context, uint32_t cell, TextureSampler* textures) {
  constexpr size_t kPortion = 16'384;
  const uint64_t triangles = context.tree.cells[cell].triangles;
  FARCELL_ASSIGN(const MemoryGate::Share share,
                 context.gate.take(std::min(triangles, kPartTriangles) * kBytesOfCodedTriangle +
                                       (context.hasTextures ? kAtlasBytes : 0),
                                   "coding a leaf"));
  const Lap lap(context.clock.encodeNs);
  const GridPoint cellMin = cellBox(context.model.grid, context.tree.cells[cell].key).min;
  MeshWriter mesh(context.store, cell);
  Parts parts([&](GridTriangles&& part) -> Result<> {
    FARCELL_TRY(checkInterrupt());
    std::optional<Atlas> atlas;
    if (!part.textures.empty()) atlas = atlasOf(part.textures, *textures);
    if (context.model.hasSides) markSides(part, *textures);
    GeometryPage page;
    if (atlas) page = geometryPage(part.triangles, cellMin, context.model, atlas->coordinates);
    const GeometryPage coloured =
        geometryPage(withTexturesAsColours(std::move(part), textures), cellMin, context.model);
    return atlas ? mesh.add(page, atlas->image, coloured) : mesh.add(coloured);
  });
  const size_t list = context.partition.leaves[context.tree.leafOf[cell]].list;
  FARCELL_TRY(context.partition.triangles.forEachPortion(
      list, kPortion, [&](const GridTriangleSpan& portion) { return parts.add(portion); }));
  FARCELL_TRY(parts.flush());
  if (textures != nullptr && textures->failure()) return tl::unexpected<Error>(*textures->failure());
  return mesh.finish(triangles, 0);
}

Result<> simplifyInner(const BuildContext& context, uint32_t cell) {
  const CellRecord& record = context.tree.cells[cell];
  const auto leafTriangles = static_cast<uint64_t>(context.model.settings.leafTriangles);
  const Children children = childrenOf(context, record);
  if (!children.whole || children.triangles > kMaxSimplifiedLeaves * leafTriangles)
    return context.store.add(cell, MeshFigures{});
  FARCELL_ASSIGN(const MemoryGate::Share share,
                 context.gate.take(children.triangles * kBytesOfSimplifiedTriangle, "simplifying a cell"));
  const Lap lap(context.clock.meshNs);
  std::vector<LodMesh> meshes;
  for (uint32_t child = record.firstChild; child < record.firstChild + record.childCount; ++child) {
    FARCELL_ASSIGN(LodMesh mesh, storedMesh(context, child));
    meshes.push_back(std::move(mesh));
  }
  // A surface four times as large, twice as coarse: as many triangles as a leaf has on average.
  const BuildSettings& build = context.model.settings;
  LodSettings settings{std::max<uint64_t>(1, leafTriangles / 2), build.simplifier};
  if (build.lighting == Lighting::baked) settings.sun = sunDirection(build.up, build.sun);
  FARCELL_ASSIGN(const SimplifiedCell simplified,
                 simplifyCell(context.model.grid, record.key, meshes, children.errorSteps, settings));
  meshes.clear();
  const LodMesh& mesh = simplified.mesh;
  const GridPoint cellMin = cellBox(context.model.grid, record.key).min;
  MeshWriter coded(context.store, cell);
  for (size_t first = 0; first < mesh.triangles(); first += kPartTriangles)
    FARCELL_TRY(coded.add(pageOf(mesh, first, std::min<size_t>(kPartTriangles, mesh.triangles() - first), cellMin)));
  return coded.finish(mesh.triangles(), simplified.errorSteps);
}

std::vector<uint32_t> leavesOf(const CellTree& tree) {
  std::vector<uint32_t> leaves;
  for (uint32_t cell = 0; cell < tree.cells.size(); ++cell)
    if (tree.cells[cell].childCount == 0) leaves.push_back(cell);
  return leaves;
}

std::vector<std::vector<uint32_t>> innerCellsFromTheBottom(const CellTree& tree) {
  std::map<uint32_t, std::vector<uint32_t>, std::greater<>> byLevel;
  for (uint32_t cell = 0; cell < tree.cells.size(); ++cell)
    if (tree.cells[cell].childCount > 0) byLevel[tree.cells[cell].key.level].push_back(cell);
  std::vector<std::vector<uint32_t>> levels;
  for (auto& [level, cells] : byLevel) levels.push_back(std::move(cells));
  return levels;
}

}  // namespace farcell
