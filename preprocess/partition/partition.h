// From a stream of triangles to the leaves of an octree.
//
// 1. bounds: a pass over the mesh finds the box of what is accepted, and with it the root cube and its grid.
// 2. spool: a second pass puts every triangle on the grid, writes it to scratch and counts it in a coarse histogram.
// 3. scatter: the histogram names chunks small enough for memory; each triangle is cut into the chunks it meets.
// 4. split: each chunk is loaded and cut, level by level, until the rule below says leaf; leaves go back to scratch.
//
// A cell is split while it holds more than leafTriangles, or while its triangles are much finer than the texels of its
// views (kTrianglesPerTexel) and more than a leaf is worth: counts alone leave a dense heap in a large, empty cell too
// coarse for its impostor and too costly for its triangles. A split that would multiply the pieces (kMaxGrowth: large
// triangles that cover the cell, heaps that no plane separates) is not done: it would only make more of the same.
#pragma once

#include <filesystem>
#include <vector>

#include "cache/base/progress.h"
#include "cache/schema/model.h"
#include "preprocess/mesh/mesh_reader.h"
#include "preprocess/partition/triangle_lists.h"

namespace farcell {

// A leaf of fewer triangles than this share of leafTriangles is never split for fineness alone.
inline constexpr int kFinenessShare = 2;
inline constexpr double kTrianglesPerTexel = 2;
inline constexpr double kMaxGrowth = 2;

struct Leaf {
  CellKey key;
  GridBox content;
  size_t list = 0;  // in Partition::triangles
};

struct Partition {
  Grid grid;
  GridBox bounds;
  MeshCounts counts;
  std::vector<Leaf> leaves;  // by level, then Morton code
  TriangleLists triangles;
  double splitSeconds = 0;  // steps 3 and 4
};

// invalidArgument when the mesh has no triangle that can be drawn.
Result<Partition> partitionMesh(MeshReader& mesh, const BuildSettings& settings,
                                const std::filesystem::path& scratchDirectory, int threads, Progress& progress);

}  // namespace farcell
