// What a build has to know of its input once the partition is done, kept in the work directory: so that going on, and
// the other processes of a crew, need not read the input again, which for a text format means all of it.
#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "preprocess/mesh/mesh_reader.h"

namespace farcell {

struct SourceRecord {
  MeshInfo info;
  std::vector<std::filesystem::path> files;  // MeshReader::files()
  std::string identity;                      // of them, SourceIdentity::text()
  uint64_t hash = 0;                         // sourceHash of them
  uint64_t textures = 0;

  // Reads every file whole, for the hash.
  static Result<SourceRecord> of(const MeshReader& mesh);
  // What save() left for the same meshes, while all files are as they were.
  static std::optional<SourceRecord> load(const std::filesystem::path& workDirectory,
                                          std::span<const std::filesystem::path> meshes);
  Result<> save(const std::filesystem::path& workDirectory, std::span<const std::filesystem::path> meshes) const;
};

}  // namespace farcell
