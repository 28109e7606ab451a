// From mesh files to a pack file.
//
// The life of a build: WorkDirectory::open -> openMeshes -> Textures::open -> partitionMesh (leaves on disk) ->
// cellTreeOf (every cell up to the root) -> jobs on all threads (mesh_job.h, then bake_job.h, measure_job.h), each of
// which stores what it has finished (cell_store.h) -> chooseViews (what is worth its bytes) -> assemblePack. What
// partition and jobs have made lies in the work directory: a build that was killed goes on from it. Same input and
// settings, same bytes, for any number of threads and processes, any memory, and however often it was interrupted.
// CLUSTER.md: many machines.
#pragma once

#include <filesystem>
#include <functional>
#include <span>
#include <vector>

#include "cache/base/progress.h"
#include "cache/base/result.h"
#include "cache/pack/directory.h"
#include "preprocess/build/crew.h"
#include "preprocess/measure/choose_forms.h"
#include "preprocess/measure/expect_errors.h"

namespace farcell {

inline constexpr uint64_t kDefaultMemoryBytes = uint64_t{2} << 30;
inline constexpr uint64_t kMinMemoryBytes = uint64_t{192} << 20;

struct BuildOptions {
  BuildSettings settings;
  bool upOfModel = false;                             // settings.up is as the files say (MeshInfo) instead
  bool unitOfModel = false;                           // settings.metresPerUnit likewise
  int threads = 0;                                    // 0: all
  uint64_t memoryBytes = kDefaultMemoryBytes;         // ceiling of this process's memory, at least kMinMemoryBytes
  std::string visitable = "everywhere";               // where visitors may be, as readRegion takes it
  std::filesystem::path workParent;                   // where the work directory lies; empty: where the pack goes
  Crew* crew = nullptr;                               // null: this process alone
  std::function<void(const std::string& line)> tell;  // what people want to know before it begins; may be empty
};

// Seconds; lod, bake, encode and measure overlap, and share the wall time of all jobs by the processor time of each.
struct StageSeconds {
  double read = 0, partition = 0, lod = 0, bake = 0, encode = 0, measure = 0, total = 0;
};

// Images that the mesh names. One that cannot be read is no error: its triangles keep the colours they have without it.
struct TextureReport {
  uint64_t read = 0;
  std::vector<Error> leftOut;  // why, one for each image
};

// What was measured, and how well it tells of what was not.
struct MeasureReport {
  uint64_t cells = 0;
  double unit = 0;  // ErrorTable's 1
  std::array<std::array<ExpectedApart, kErrorScales>, kErrorWays> apart{};
  ChosenForms forms;  // of Forms::chosen
};

struct BuildResult {
  bool resumed = false;  // work that an earlier build had left was used
  Directory directory;
  uint64_t packBytes = 0;
  StageSeconds seconds;     // wall
  StageSeconds cpuSeconds;  // processor time of this process's threads; lod, bake, encode and measure only
  TextureReport textures;
  MeasureReport measured;
  std::vector<std::filesystem::path> files;  // that it was read from, see MeshReader
};

// Several meshes are one model; the pack's sourceName is the first one's. With a crew all processes call it alike, see
// the same work directory, and the one that leads writes the pack. After success the work directory is gone; after
// cancelled, io and exhausted what a next call goes on from stays, after other errors nothing. exhausted also when the
// disk cannot hold the work or the budget not even the meshes.
Result<BuildResult> buildPack(std::span<const std::filesystem::path> meshes, const std::filesystem::path& pack,
                              const BuildOptions& options, Progress& progress);

// invalidArgument, naming the member, the allowed range and the value found.
Result<> checkSettings(const BuildSettings& settings);

}  // namespace farcell
