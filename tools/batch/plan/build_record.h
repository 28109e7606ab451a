// What a pack was built from, kept beside it as <name>.json, so that a second run knows which packs are current.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "cache/base/result.h"

namespace farcell {

// A file as it stood: another size or time, and it may be another file.
struct FileIdentity {
  std::string path;  // absolute
  uint64_t bytes = 0;
  int64_t modifiedNs = 0;  // since 1970
  bool operator==(const FileIdentity&) const = default;
};

Result<FileIdentity> identityOf(const std::filesystem::path& path);

struct BuildRecord {
  std::string version;                 // of farcell
  std::vector<std::string> arguments;  // of the build
  FileIdentity pack;
  std::vector<FileIdentity> files;  // all that the model was read from
  uint64_t triangles = 0;
  bool operator==(const BuildRecord&) const = default;
};

std::string recordText(const BuildRecord& record);
// Nothing when the text is not one of recordText's: a reason to build again, not to fail.
std::optional<BuildRecord> parseRecord(const std::string& text);

// The record at `path`, if the pack of these arguments is current: all files are as they were.
std::optional<BuildRecord> currentRecord(const std::filesystem::path& path, const std::vector<std::string>& arguments);

}  // namespace farcell
