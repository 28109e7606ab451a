// Whether input files are still those that a build was begun with, told without reading them.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "preprocess/mesh/mesh_reader.h"

namespace farcell {

// What the file system says of one file.
struct FileIdentity {
  std::string path;  // absolute
  uint64_t sizeBytes = 0;
  int64_t modifiedNs = 0;  // since 1970
  uint64_t inode = 0;

  bool operator==(const FileIdentity&) const = default;
};

// Of MeshReader::files(), in their order. Equal identities: the same files, unchanged, as far as times tell; sourceHash
// (source_hash.h) is the proof.
struct SourceIdentity {
  std::vector<FileIdentity> files;

  bool operator==(const SourceIdentity&) const = default;
  // A line for each file: size, time, inode, path; blanks between them; line ends and backslashes of a path escaped.
  std::string text() const;
  // corrupt, naming `name`, when `text` is none that text() gives.
  static Result<SourceIdentity> parse(const std::string& name, std::string_view text);
  // The first difference, for a message: "city.ply: 120 bytes, before 118"; empty when there is none.
  std::string changeSince(const SourceIdentity& before) const;
};

Result<SourceIdentity> sourceIdentity(const MeshReader& mesh);

}  // namespace farcell
