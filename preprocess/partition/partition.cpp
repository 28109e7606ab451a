#include "preprocess/partition/partition.h"

#include <algorithm>
#include <chrono>
#include <glm/geometric.hpp>
#include <map>
#include <optional>

#include "cache/base/interrupt.h"
#include "cache/base/parallel.h"
#include "cache/schema/view_frame.h"
#include "preprocess/partition/grid_triangle.h"
#include "preprocess/partition/spool.h"

namespace farcell {
namespace {

constexpr uint64_t kChunkTriangles = 1'000'000;  // what one thread may hold while it splits a chunk
constexpr size_t kPortion = 16'384;              // triangles of one scratch read or write

double secondsSince(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

// The three planes through a cell's centre.
GridPoint middleOf(const Grid& grid, const CellKey& key) {
  const GridBox box = cellBox(grid, key);
  return GridPoint(box.min.x + (box.max.x - box.min.x) / 2, box.min.y + (box.max.y - box.min.y) / 2,
                   box.min.z + (box.max.z - box.min.z) / 2);
}

// What a cell holds while it is being split: triangles no plane has cut yet, and the pieces of the others.
struct Pieces {
  GridTriangles whole;
  std::vector<GridPolygon> cut;
  size_t size() const { return whole.size() + cut.size(); }
  size_t triangles() const {
    size_t sum = whole.size();
    for (const GridPolygon& polygon : cut) sum += static_cast<size_t>(polygon.count - 2);
    return sum;
  }
};
using Octants = std::array<Pieces, 8>;

// The octant around `middle` that a box lies in; -1 when it reaches across a plane.
int octantOf(const GridBox& box, GridPoint middle) {
  int octant = 0;
  for (int axis = 0; axis < 3; ++axis) {
    if (box.min[axis] >= middle[axis])
      octant |= 1 << axis;
    else if (box.max[axis] > middle[axis])
      return -1;
  }
  return octant;
}

// Cuts along x, then y, then z.
void cutToOctants(const GridPolygon& polygon, GridPoint middle, Octants& octants) {
  const auto put = [&](const GridPolygon& part, size_t octant) {
    if (part.count > 0) octants[octant].cut.push_back(part);
  };
  const CutPolygon byX = cutAt(polygon, 0, middle.x);
  for (size_t x = 0; x < 2; ++x) {
    const CutPolygon byY = cutAt(x == 0 ? byX.low : byX.high, 1, middle.y);
    for (size_t y = 0; y < 2; ++y) {
      const CutPolygon byZ = cutAt(y == 0 ? byY.low : byY.high, 2, middle.z);
      put(byZ.low, x | y << 1);
      put(byZ.high, x | y << 1 | 4);
    }
  }
}

void scatterToOctants(const GridTriangle& triangle, const TriangleTexture& texture, GridPoint middle,
                      Octants& octants) {
  if (const int octant = octantOf(boxOf(triangle), middle); octant >= 0)
    octants[static_cast<size_t>(octant)].whole.add(triangle, texture);
  else
    cutToOctants(polygonOf(triangle, texture), middle, octants);
}

// ---- scatter: chunks ----

struct ChunkTree {
  static constexpr int kInner = -1;
  std::map<CellKey, int> nodes;  // kInner, or the index of a chunk's list
  std::vector<CellKey> chunks;
};

void chooseChunks(const Spool& spool, const BuildSettings& settings, const CellKey& key, ChunkTree& tree) {
  const uint64_t count = spool.histogram[key.level][mortonCode(key)];
  const uint32_t deepest = settings.fixedLevel >= 0 ? static_cast<uint32_t>(settings.fixedLevel) : kHistogramLevel;
  if (count <= kChunkTriangles ||
      key.level >= std::min({deepest, kHistogramLevel, static_cast<uint32_t>(settings.maxLevel)})) {
    tree.nodes[key] = static_cast<int>(tree.chunks.size());
    tree.chunks.push_back(key);
    return;
  }
  tree.nodes[key] = ChunkTree::kInner;
  for (uint32_t octant = 0; octant < 8; ++octant) chooseChunks(spool, settings, key.child(octant), tree);
}

// Sends triangles down the chunk tree; full buffers go to scratch.
class ChunkScatter {
 public:
  ChunkScatter(const Grid& grid, const ChunkTree& tree, TriangleLists& lists)
      : grid_(grid), tree_(tree), lists_(lists), buffers_(tree.chunks.size()) {}

  Result<> put(const GridTriangleSpan& portion) {
    for (size_t i = 0; i < portion.size(); ++i)
      FARCELL_TRY(put(polygonOf(portion.triangles[i], portion.texture(i)), CellKey{}));
    return {};
  }

  Result<> finish() {
    for (size_t chunk = 0; chunk < buffers_.size(); ++chunk) FARCELL_TRY(flush(chunk));
    return {};
  }

 private:
  Result<> put(const GridPolygon& polygon, const CellKey& key) {
    const int chunk = tree_.nodes.at(key);
    if (chunk >= 0) {
      appendTriangles(polygon, buffers_[chunk]);
      return buffers_[chunk].size() >= kPortion ? flush(static_cast<size_t>(chunk)) : Result<>{};
    }
    const GridPoint middle = middleOf(grid_, key);
    if (const int octant = octantOf(boxOf(polygon), middle); octant >= 0)
      return put(polygon, key.child(static_cast<uint32_t>(octant)));
    Octants octants;
    cutToOctants(polygon, middle, octants);
    for (uint32_t octant = 0; octant < 8; ++octant)
      for (const GridPolygon& part : octants[octant].cut) FARCELL_TRY(put(part, key.child(octant)));
    return {};
  }

  Result<> flush(size_t chunk) {
    FARCELL_TRY(lists_.append(chunk, buffers_[chunk]));
    buffers_[chunk].clear();
    return {};
  }

  const Grid& grid_;
  const ChunkTree& tree_;
  TriangleLists& lists_;
  std::vector<GridTriangles> buffers_;
};

// ---- split: leaves ----

class LeafSplitter {
 public:
  LeafSplitter(const Grid& grid, const BuildSettings& settings, TriangleLists& leafLists)
      : grid_(grid), settings_(settings), leafLists_(leafLists) {}

  Result<> split(const CellKey& key, Pieces pieces, std::vector<Leaf>& leaves) const {
    if (pieces.size() == 0) return {};
    if (!shouldSplit(key, pieces)) return writeLeaf(key, pieces, leaves);
    const GridPoint middle = middleOf(grid_, key);
    Octants octants;
    const GridTriangleSpan whole = pieces.whole;
    for (size_t i = 0; i < whole.size(); ++i) scatterToOctants(whole.triangles[i], whole.texture(i), middle, octants);
    for (const GridPolygon& polygon : pieces.cut) cutToOctants(polygon, middle, octants);
    size_t after = 0;
    for (const Pieces& octant : octants) after += octant.size();
    if (settings_.fixedLevel < 0 && static_cast<double>(after) > kMaxGrowth * static_cast<double>(pieces.size()))
      return writeLeaf(key, pieces, leaves);
    pieces = {};
    for (uint32_t octant = 0; octant < 8; ++octant)
      FARCELL_TRY(split(key.child(octant), std::move(octants[octant]), leaves));
    return {};
  }

 private:
  bool shouldSplit(const CellKey& key, const Pieces& pieces) const {
    const int level = static_cast<int>(key.level);
    if (settings_.fixedLevel >= 0) return level < settings_.fixedLevel;
    if (level >= settings_.maxLevel) return false;
    const auto leafTriangles = static_cast<size_t>(settings_.leafTriangles);
    const size_t triangles = pieces.triangles();
    if (triangles > leafTriangles) return true;
    return triangles > leafTriangles / kFinenessShare &&
           static_cast<double>(triangles) > kTrianglesPerTexel * coveredTexels(key, pieces);
  }

  // Texels that a view of the cell would cover: a surface shows a quarter of its area on average (Cauchy).
  double coveredTexels(const CellKey& key, const Pieces& pieces) const {
    double areaSteps = 0;
    const auto add = [&](GridPoint a, GridPoint b, GridPoint c) {
      areaSteps += 0.5 * glm::length(glm::cross(glm::dvec3(b - a), glm::dvec3(c - a)));
    };
    for (const GridTriangle& triangle : pieces.whole.triangles)
      add(triangle.corners[0], triangle.corners[1], triangle.corners[2]);
    for (const GridPolygon& polygon : pieces.cut)
      for (int i = 2; i < polygon.count; ++i)
        add(polygon.corners[0].position, polygon.corners[i - 1].position, polygon.corners[i].position);
    const double texelSteps = texelSize(settings_.imageSize) * 0.5 *
                              static_cast<double>(int64_t{1} << (grid_.bits - static_cast<int>(key.level)));
    return std::max(1.0, areaSteps / (4 * texelSteps * texelSteps));
  }

  Result<> writeLeaf(const CellKey& key, const Pieces& pieces, std::vector<Leaf>& leaves) const {
    GridTriangles triangles = pieces.whole;
    for (const GridPolygon& polygon : pieces.cut) appendTriangles(polygon, triangles);
    if (triangles.size() == 0) return {};
    Leaf leaf{key, {}, leafLists_.addList()};
    for (const GridTriangle& triangle : triangles.triangles) leaf.content.include(boxOf(triangle));
    leaves.push_back(leaf);
    return leafLists_.append(leaf.list, triangles);
  }

  const Grid& grid_;
  const BuildSettings& settings_;
  TriangleLists& leafLists_;
};

Result<TriangleLists> scatterToChunks(const Spool& spool, const ChunkTree& tree,
                                      const std::filesystem::path& scratchDirectory, Progress& progress) {
  progress.begin("scatter", spool.triangles.size(0), "triangles");
  FARCELL_ASSIGN(TriangleLists lists, TriangleLists::create(scratchDirectory, tree.chunks.size()));
  ChunkScatter scatter(spool.grid, tree, lists);
  FARCELL_TRY(spool.triangles.forEachPortion(0, kPortion, [&](const GridTriangleSpan& portion) -> Result<> {
    FARCELL_TRY(scatter.put(portion));
    progress.advance(portion.size());
    return checkInterrupt();
  }));
  FARCELL_TRY(scatter.finish());
  return lists;
}

bool byLevelThenMorton(const CellKey& a, const CellKey& b) {
  return a.level != b.level ? a.level < b.level : mortonCode(a) < mortonCode(b);
}

// All leaves of all chunks, each chunk split by one thread.
Result<std::vector<Leaf>> splitChunks(const ChunkTree& tree, const TriangleLists& chunks, const LeafSplitter& splitter,
                                      int threads, Progress& progress) {
  progress.begin("split", tree.chunks.size(), "chunks");
  std::vector<std::vector<Leaf>> leavesOfChunk(tree.chunks.size());
  std::vector<std::optional<Error>> errors(tree.chunks.size());
  parallelFor(tree.chunks.size(), threads, [&](size_t chunk, int) {
    const auto work = [&]() -> Result<> {
      FARCELL_TRY(checkInterrupt());
      FARCELL_ASSIGN(GridTriangles triangles, chunks.read(chunk));
      return splitter.split(tree.chunks[chunk], Pieces{std::move(triangles), {}}, leavesOfChunk[chunk]);
    };
    if (const Result<> done = work(); !done) errors[chunk] = done.error();
    progress.advance();
  });
  std::vector<Leaf> leaves;
  for (size_t chunk = 0; chunk < tree.chunks.size(); ++chunk) {
    if (errors[chunk]) return tl::unexpected<Error>(*errors[chunk]);
    leaves.insert(leaves.end(), leavesOfChunk[chunk].begin(), leavesOfChunk[chunk].end());
  }
  std::sort(leaves.begin(), leaves.end(), [](const Leaf& a, const Leaf& b) { return byLevelThenMorton(a.key, b.key); });
  return leaves;
}

}  // namespace

Result<Partition> partitionMesh(MeshReader& mesh, const BuildSettings& settings,
                                const std::filesystem::path& scratchDirectory, int threads, Progress& progress) {
  FARCELL_ASSIGN(Spool spool, spoolMesh(mesh, scratchDirectory, progress));
  const auto start = std::chrono::steady_clock::now();
  ChunkTree tree;
  chooseChunks(spool, settings, CellKey{}, tree);
  FARCELL_ASSIGN(const TriangleLists chunks, scatterToChunks(spool, tree, scratchDirectory, progress));
  FARCELL_ASSIGN(TriangleLists leafLists, TriangleLists::create(scratchDirectory, 0));
  const LeafSplitter splitter(spool.grid, settings, leafLists);
  FARCELL_ASSIGN(std::vector<Leaf> leaves, splitChunks(tree, chunks, splitter, threads, progress));
  return Partition{spool.grid,        spool.bounds,         std::move(spool.counts),
                   std::move(leaves), std::move(leafLists), secondsSince(start)};
}

}  // namespace farcell
