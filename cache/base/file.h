// The one layer through which every byte of a file goes: bounded positional reads, and files that appear
// whole or not at all. No memory mapping: a mapped file that shrinks under its reader kills the process.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "cache/base/result.h"

namespace farcell {

// A regular file opened for reading. Move-only; reads may come from several threads at once.
class InputFile {
 public:
  // Refuses directories, FIFOs and devices (they could block for ever or have no size).
  static Result<InputFile> open(const std::filesystem::path& path);
  InputFile(InputFile&& other) noexcept;
  InputFile& operator=(InputFile&& other) noexcept;
  InputFile(const InputFile&) = delete;
  InputFile& operator=(const InputFile&) = delete;
  ~InputFile();

  const std::string& path() const { return path_; }
  uint64_t sizeBytes() const { return sizeBytes_; }  // as it was when opened
  // Fills `out` entirely from `offset`, or fails naming path and offset.
  Result<> readAt(uint64_t offset, std::span<std::byte> out) const;

 private:
  InputFile(int descriptor, std::string path, uint64_t sizeBytes);
  int descriptor_ = -1;
  std::string path_;
  uint64_t sizeBytes_ = 0;
};

// A file written from start to end under a temporary name beside its final one, <name>.partial. `commit` syncs it,
// renames it and syncs the directory; without a commit the temporary file is removed and an older file stays whole.
// What a killed process leaves, the next one that writes the same file takes over.
class OutputFile {
 public:
  // Refuses a path where a directory, FIFO or device stands.
  static Result<OutputFile> create(const std::filesystem::path& path);
  OutputFile(OutputFile&& other) noexcept;
  OutputFile& operator=(OutputFile&&) = delete;
  OutputFile(const OutputFile&) = delete;
  ~OutputFile();

  uint64_t sizeBytes() const { return sizeBytes_; }  // appended so far
  Result<> append(std::span<const std::byte> bytes);
  Result<> commit();

 private:
  OutputFile(int descriptor, std::filesystem::path path, std::filesystem::path temporary);
  Result<> flush();
  int descriptor_ = -1;
  std::filesystem::path path_;
  std::filesystem::path temporary_;
  std::vector<std::byte> buffer_;
  uint64_t sizeBytes_ = 0;
};

// A file written at any offset and read back, from several threads at once. Without a name it is gone with its owner
// or a crash; with one it stays until somebody removes it.
class ScratchFile {
 public:
  static Result<ScratchFile> create(const std::filesystem::path& directory);
  // The named file as it is, or a new, empty one.
  static Result<ScratchFile> open(const std::filesystem::path& path);
  ScratchFile(ScratchFile&& other) noexcept;
  ScratchFile& operator=(ScratchFile&& other) noexcept;
  ScratchFile(const ScratchFile&) = delete;
  ScratchFile& operator=(const ScratchFile&) = delete;
  ~ScratchFile();

  Result<> writeAt(uint64_t offset, std::span<const std::byte> bytes);
  Result<> readAt(uint64_t offset, std::span<std::byte> out) const;
  Result<uint64_t> sizeBytes() const;
  Result<> truncate(uint64_t sizeBytes);
  // Returns when a loss of power cannot take back what was written.
  Result<> sync();

 private:
  ScratchFile(int descriptor, std::string path);
  int descriptor_ = -1;
  std::string path_;  // for messages; that of the directory where the file has no name
};

// A file that grows at its end and is read back at once, under its own name from the beginning: what outlives a crash.
class GrowingFile {
 public:
  // Opens or creates it; refuses what is no regular file.
  static Result<GrowingFile> open(const std::filesystem::path& path);
  GrowingFile(GrowingFile&& other) noexcept;
  GrowingFile& operator=(GrowingFile&&) = delete;
  GrowingFile(const GrowingFile&) = delete;
  GrowingFile& operator=(const GrowingFile&) = delete;
  ~GrowingFile();

  const std::string& path() const { return path_; }
  uint64_t sizeBytes() const { return sizeBytes_; }  // as opened, and what was added
  Result<> readAt(uint64_t offset, std::span<std::byte> out) const;
  Result<> append(std::span<const std::byte> bytes);
  Result<> truncate(uint64_t sizeBytes);
  Result<> sync();

 private:
  GrowingFile(int descriptor, std::string path, uint64_t sizeBytes);
  int descriptor_ = -1;
  std::string path_;
  uint64_t sizeBytes_ = 0;
};

// A whole small text file (JSON and the like); fails with `exhausted` above `maxBytes`.
Result<std::string> readTextFile(const std::filesystem::path& path, uint64_t maxBytes);
// Writes through OutputFile.
Result<> writeTextFile(const std::filesystem::path& path, const std::string& text);

}  // namespace farcell
