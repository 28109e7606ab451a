// Steps 1 and 2 of the partition: the mesh on its grid, in scratch, with a histogram of where its triangles lie.
#pragma once

#include <array>
#include <vector>

#include "cache/base/progress.h"
#include "preprocess/mesh/mesh_reader.h"
#include "preprocess/partition/triangle_lists.h"

namespace farcell {

inline constexpr uint32_t kHistogramLevel = 6;

struct Spool {
  Grid grid;
  GridBox bounds;
  MeshCounts counts;
  TriangleLists triangles;                                           // list 0: everything
  std::array<std::vector<uint64_t>, kHistogramLevel + 1> histogram;  // per level, by Morton code of the cell
};

Result<Spool> spoolMesh(MeshReader& mesh, const std::filesystem::path& scratchDirectory, Progress& progress);

}  // namespace farcell
