// Steps 1 and 2 of the partition: the mesh on its grid, in scratch, sorted into the cells of the octree's upper levels.
#pragma once

#include <memory>

#include "cache/base/progress.h"
#include "cache/base/sealed_file.h"
#include "cache/schema/model.h"
#include "preprocess/mesh/mesh_reader.h"
#include "preprocess/partition/bucket_file.h"

namespace farcell {

struct MeshMeasure {
  Grid grid;  // around all accepted triangles, see root_cube.h
  MeshCounts counts;
};

// Kept in `file`, and taken from there when it is whole. corrupt when the mesh has no triangle that can be drawn.
Result<MeshMeasure> measureMesh(MeshReader& mesh, const BuildSettings& settings, const std::filesystem::path& file,
                                Progress& progress);

void putCounts(SealedWriter& writer, const MeshCounts& counts);
bool getCounts(SealedReader& reader, MeshCounts& counts);

RecordFormat recordFormatOf(const MeshReader& mesh);

struct SpoolOptions {
  std::filesystem::path file;
  int depth;  // levels of the octree
  int threads;
  uint64_t memoryBytes;
};
// Goes on where an earlier run ended: triangles that are in the file already are read from the mesh and passed over.
Result<std::shared_ptr<const BucketFile>> spoolMesh(MeshReader& mesh, const Grid& grid, uint64_t triangles,
                                                    const SpoolOptions& options, Progress& progress);

}  // namespace farcell
