#include "preprocess/build/mesh_job.h"

#include <algorithm>
#include <map>

#include "cache/base/interrupt.h"
#include "preprocess/encode/geometry_page.h"
#include "preprocess/encode/vertex_colours.h"

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

CodedPart codedPart(const GeometryPage& page) {
  const GeometryPage ordered = optimisedOrder(page);
  return {decodedSizeBytes(ordered), encodeGeometryPage(ordered)};
}

}  // namespace

Result<> codeLeaf(const BuildContext& context, uint32_t cell, TextureSampler* textures) {
  constexpr size_t kPortion = 16'384;
  const uint64_t triangles = context.tree.cells[cell].triangles;
  FARCELL_ASSIGN(const MemoryGate::Share share,
                 context.gate.take(std::min(triangles, kPartTriangles) * kBytesOfCodedTriangle, "coding a leaf"));
  const Lap lap(context.clock.encodeNs);
  const GridPoint cellMin = cellBox(context.model.grid, context.tree.cells[cell].key).min;
  CodedMesh mesh{triangles, 0, {}};
  Parts parts([&](GridTriangles&& part) -> Result<> {
    FARCELL_TRY(checkInterrupt());
    const std::vector<GridTriangle> coloured = withTexturesAsColours(std::move(part), textures);
    mesh.parts.push_back(codedPart(geometryPage(coloured, cellMin, context.model)));
    return {};
  });
  const size_t list = context.partition.leaves[context.tree.leafOf[cell]].list;
  FARCELL_TRY(context.partition.triangles.forEachPortion(
      list, kPortion, [&](const GridTriangleSpan& portion) { return parts.add(portion); }));
  FARCELL_TRY(parts.flush());
  if (textures != nullptr && textures->failure()) return tl::unexpected<Error>(*textures->failure());
  return context.store.add(cell, mesh);
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
