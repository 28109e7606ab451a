// Many append-only lists of triangles in one scratch file: what keeps a model larger than memory on disk.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <mutex>
#include <vector>

#include "cache/base/file.h"
#include "preprocess/partition/grid_triangles.h"

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
  Result<> append(size_t list, const GridTriangleSpan& triangles);
  Result<GridTriangles> read(size_t list) const;
  // The same in portions of at most `portion` triangles.
  Result<> forEachPortion(size_t list, size_t portion,
                          const std::function<Result<>(const GridTriangleSpan&)>& sink) const;

 private:
  // Triangles, and after them, where any has one, their textures.
  struct Run {
    uint64_t offsetBytes;
    uint64_t size;
    bool textured;
  };
  struct List {
    uint64_t size = 0;
    std::vector<Run> runs;
  };
  explicit TriangleLists(ScratchFile file) : file_(std::move(file)) {}
  // Appends triangles [first, first + count) of a run.
  Result<> readRun(const Run& run, uint64_t first, uint64_t count, GridTriangles& out) const;

  ScratchFile file_;
  std::mutex mutex_;
  // Guarded by mutex_ while lists are appended to:
  uint64_t endBytes_ = 0;
  std::vector<List> lists_;
};

}  // namespace farcell
