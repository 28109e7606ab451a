// Whether input files are still those that a build was begun with, told without reading them.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "cache/base/result.h"

namespace farcell {

// What the file system says of one file.
struct FileIdentity {
  std::string path;  // absolute
  uint64_t sizeBytes = 0;
  int64_t modifiedNs = 0;  // since 1970
  uint64_t inode = 0;
};

// Of MeshReader::files(), in their order. Equal identities: the same files, unchanged, as far as times tell; sourceHash
// (source_hash.h) is the proof.
struct SourceIdentity {
  std::vector<FileIdentity> files;

  // A line for each file: size, time, inode, path; blanks between them; line ends and backslashes of a path escaped.
  std::string text() const;
};

Result<SourceIdentity> sourceIdentity(std::span<const std::filesystem::path> files);

}  // namespace farcell
