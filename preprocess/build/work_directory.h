// Where a build keeps what it has done so far, so that the same command goes on after a crash.
//
// It belongs to one pack, and to one identity: everything that decides what partition and jobs make (source files,
// settings but for the pack's budget, versions). What another identity left there is removed. One build at a time works
// in it:
//   lock, identity     of this header
//   partition/         leaves and their index (partition.h)
//   textures, .tiles   the images that colour it (textures.h)
//   source             what was read of the meshes, once partition and textures are whole (source_record.h)
//   cells.<n>.log      the journal of process n (journal.h, cell_store.h)
// and scratch of readers.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

#include "cache/base/result.h"

namespace farcell {

class WorkDirectory {
 public:
  // `parent`/<name of the pack>.work; with a parent other than the pack's own directory, made unique by a hash of the
  // pack's whole path. Makes and locks it; io when another build holds the lock.
  static Result<WorkDirectory> open(const std::filesystem::path& parent, const std::filesystem::path& pack);
  // The same place, which another process has opened and keeps locked.
  static std::filesystem::path placeOf(const std::filesystem::path& parent, const std::filesystem::path& pack);
  WorkDirectory(WorkDirectory&& other) noexcept;
  WorkDirectory& operator=(WorkDirectory&&) = delete;
  WorkDirectory(const WorkDirectory&) = delete;
  WorkDirectory& operator=(const WorkDirectory&) = delete;
  // Gives up the lock; the files stay.
  ~WorkDirectory();

  const std::filesystem::path& path() const { return path_; }
  // Whether what is there belongs to this identity; if not, it is emptied and from now on does.
  Result<bool> belongsTo(const std::string& identity) const;
  // Whether there is anything that an interrupted build could go on from.
  bool holdsWork() const;
  // Removes the directory and all in it.
  Result<> remove();

 private:
  WorkDirectory(std::filesystem::path path, int lock) : path_(std::move(path)), lock_(lock) {}
  std::filesystem::path path_;
  int lock_ = -1;
};

// Bytes that may still be written to the file system of a directory; and the sizes of all files in it together.
Result<uint64_t> freeBytes(const std::filesystem::path& directory);
uint64_t directoryBytes(const std::filesystem::path& directory);

}  // namespace farcell
