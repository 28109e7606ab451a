// Many append-only lists of triangles in one scratch file: what keeps a model larger than memory on disk.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <mutex>
#include <span>
#include <vector>

#include "cache/base/file.h"
#include "preprocess/partition/grid_triangle.h"

namespace farcell {

// Appends may come from several threads; a list is read after the last append to it.
class TriangleLists {
 public:
  static Result<TriangleLists> create(const std::filesystem::path& scratchDirectory, size_t listCount);
  TriangleLists(TriangleLists&& other) noexcept;

  // Adds an empty list; returns its index.
  size_t addList();
  uint64_t size(size_t list) const { return lists_[list].size; }
  // Written at once, as one run of records: append in portions of thousands.
  Result<> append(size_t list, std::span<const GridTriangle> triangles);
  Result<std::vector<GridTriangle>> read(size_t list) const;
  // The same in portions of at most `portion` triangles.
  Result<> forEachPortion(size_t list, size_t portion,
                          const std::function<Result<>(std::span<const GridTriangle>)>& sink) const;

 private:
  struct Run {
    uint64_t offsetBytes;
    uint64_t size;
  };
  struct List {
    uint64_t size = 0;
    std::vector<Run> runs;
  };
  explicit TriangleLists(ScratchFile file) : file_(std::move(file)) {}

  ScratchFile file_;
  std::mutex mutex_;
  // Guarded by mutex_ while lists are appended to:
  uint64_t endBytes_ = 0;
  std::vector<List> lists_;
};

}  // namespace farcell
