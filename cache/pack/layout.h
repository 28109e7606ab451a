// The fixed parts of a pack file, its header and its footer; FORMAT.md has the tables.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "cache/base/result.h"

namespace farcell {

inline constexpr uint64_t kHeaderBytes = 32;
inline constexpr uint64_t kFooterBytes = 80;
inline constexpr std::array<char, 8> kHeaderMagic = {'\x89', 'F', 'A', 'R', '\r', '\n', '\x1a', '\n'};
inline constexpr std::array<char, 8> kFooterMagic = {'\x89', 'R', 'A', 'F', '\r', '\n', '\x1a', '\n'};

struct Footer {
  uint64_t directoryOffset = 0;
  uint64_t directoryBytes = 0;
  uint64_t directoryChecksum = 0;
  uint64_t settingsHash = 0;  // XXH3-64 of the settings as the directory stores them
  uint64_t sourceHash = 0;
  uint64_t fileBytes = 0;
};

std::vector<std::byte> encodeHeader();
std::vector<std::byte> encodeFooter(const Footer& footer);

// Both name `path` in their errors. unsupported for another version, else corrupt.
Result<> checkHeader(std::span<const std::byte> bytes, const std::string& path);
// Checks the directory's place too: it ends where the footer begins.
Result<Footer> decodeFooter(std::span<const std::byte> bytes, uint64_t fileBytes, const std::string& path);

}  // namespace farcell
