// From mesh files to a pack file.
//
// The life of a build: openMeshes -> Textures::open -> partitionMesh (leaves in scratch) -> cellTreeOf (every cell up
// to the root) -> bakeCell for each cell, on all threads, in file order -> PackWriter, in the same order whatever
// finishes first. Same input and settings, same bytes, at any thread count.
#pragma once

#include <filesystem>
#include <span>
#include <vector>

#include "cache/base/progress.h"
#include "cache/base/result.h"
#include "cache/pack/directory.h"

namespace farcell {

struct BuildOptions {
  BuildSettings settings;
  bool upOfModel = false;                  // settings.up is as the files say (MeshInfo) instead
  bool unitOfModel = false;                // settings.metresPerUnit likewise
  int threads = 0;                         // 0: all
  std::filesystem::path scratchDirectory;  // empty: where the pack goes
};

// Wall seconds; bake and encode overlap, and share the wall time of their stage by the work of each.
struct StageSeconds {
  double read = 0, partition = 0, lod = 0, bake = 0, encode = 0, total = 0;
};

// Images that the mesh names. One that cannot be read is no error: its triangles keep the colours they have without it.
struct TextureReport {
  uint64_t read = 0;
  std::vector<Error> leftOut;  // why, one for each image
};

struct BuildResult {
  Directory directory;
  uint64_t packBytes = 0;
  StageSeconds seconds;
  TextureReport textures;
  std::vector<std::filesystem::path> files;  // that it was read from, see MeshReader
};

// Several meshes are one model; the pack's sourceName is the first one's.
Result<BuildResult> buildPack(std::span<const std::filesystem::path> meshes, const std::filesystem::path& pack,
                              const BuildOptions& options, Progress& progress);

// invalidArgument, naming the member, the allowed range and the value found.
Result<> checkSettings(const BuildSettings& settings);

}  // namespace farcell
