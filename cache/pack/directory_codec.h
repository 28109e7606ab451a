// The bytes of a pack's directory; FORMAT.md has the tables.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "cache/base/result.h"
#include "cache/pack/directory.h"

namespace farcell {

inline constexpr uint64_t kCellRecordBytes = 116;
inline constexpr uint64_t kPageRecordBytes = 40;
inline constexpr size_t kMaxNameBytes = 255;  // of the source's name and of a reason's
inline constexpr uint32_t kMaxReasons = 256;

// Where the parts of a directory lie, from the start of the file: what messages point at.
struct DirectoryPlaces {
  uint64_t model = 0;
  uint64_t cells = 0;
  uint64_t pages = 0;
};

// sourceHash is not part of it: the footer holds it.
std::vector<std::byte> encodeDirectory(const Directory& directory);

// Reads fields and counts, all within the bytes; what they mean is checkDirectory's to judge.
// `offset`: of the directory in the file, for messages and `places`.
Result<Directory> decodeDirectory(std::span<const std::byte> bytes, uint64_t offset, const std::string& path,
                                  DirectoryPlaces& places);

// XXH3-64 of the settings as the directory stores them.
uint64_t hashSettings(const BuildSettings& settings);

}  // namespace farcell
