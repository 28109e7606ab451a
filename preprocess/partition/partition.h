// From a stream of triangles to the leaves of an octree, in bounded memory and so that a killed run can go on.
//
// 1. measure: a pass over the mesh finds the box of what is accepted, and with it the root cube (root_cube.h) and its
//    grid.
// 2. spool (spool.h): a second pass puts every triangle on the grid and sorts it, through scratch, into the smallest
//    cell of the octree's upper levels that holds it whole (bucket_file.h).
// 3. split (split_phase.h): from the root down, triangles that a cell's planes cut become polygons of its octants,
//    until the rule below says leaf; cells that fit in memory are split there, by all threads, the others on disk.
// 4. seal: the leaves are made safe, and an index of them appears. From then on the partition is only read.
//
// A cell is split while it holds more than leafTriangles, or while its triangles are much finer than the texels of its
// views (kTrianglesPerTexel) and more than a leaf is worth: counts alone leave a dense heap in a large, empty cell too
// coarse for its impostor and too costly for its triangles. A split that would multiply the pieces (kMaxGrowth: large
// triangles that cover the cell, heaps that no plane separates) is not done: it would only make more of the same.
//
// Where cells are cut in memory and where on disk is fixed (SplitMemory); memory and threads decide only how much is
// done at a time. So the leaves, and the order of triangles in them, depend on the mesh and the settings alone.
//
// The work directory, whose owner sees to it that all in it comes from one mesh and one set of settings:
//   measure             result of step 1
//   spool, spool-*      bucket files: of the model, and of cells too dense for its buckets; what is whole outlives
//                       a crash
//   leaves, journal     triangles of finished leaves, and which cells are done (leaf_store.h)
//   index               the finished partition; measure, spool and journal are gone
// and files without a name, which go with their process.
#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include "cache/base/progress.h"
#include "cache/schema/model.h"
#include "preprocess/mesh/mesh_reader.h"
#include "preprocess/partition/triangle_lists.h"

namespace farcell {

// A leaf of fewer triangles than this share of leafTriangles is never split for fineness alone.
inline constexpr int kFinenessShare = 2;
inline constexpr double kTrianglesPerTexel = 64;
inline constexpr double kMaxGrowth = 2;

inline constexpr uint64_t kMinPartitionMemoryBytes = uint64_t{48} << 20;

struct PartitionOptions {
  std::filesystem::path workDirectory;
  int threads = 1;           // as many as memory allows work at once
  uint64_t memoryBytes = 0;  // of all that the partition holds, its result included; at least kMinPartitionMemoryBytes
};

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

// Goes on where an earlier call with the same directory ended; with the finished partition there, the mesh is not used.
// corrupt when the mesh has no triangle that can be drawn; exhausted when memoryBytes is too little.
Result<Partition> partitionMesh(MeshReader& mesh, const BuildSettings& settings, const PartitionOptions& options,
                                Progress& progress);

// The finished partition of a work directory, if it has one; several processes may read it. Changes nothing.
Result<std::optional<Partition>> loadPartition(const std::filesystem::path& workDirectory);

// What the work directory takes at its largest, for models whose triangles are small against the leaves.
uint64_t scratchBytesEstimate(const MeshInfo& info, bool textured = false);

}  // namespace farcell
