// The leaves' triangles on disk, read from any thread and from any process that sees the directory.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <vector>

#include "cache/base/file.h"
#include "preprocess/partition/record_format.h"

namespace farcell {

class TriangleLists {
 public:
  struct List {
    uint64_t offsetBytes;  // of its first record; the others follow
    uint64_t size;
  };
  static Result<TriangleLists> open(const std::filesystem::path& path, const RecordFormat& format,
                                    std::vector<List> lists);

  uint64_t size(size_t list) const { return lists_[list].size; }
  Result<GridTriangles> read(size_t list) const;
  // The same in portions of at most `portion` triangles.
  Result<> forEachPortion(size_t list, size_t portion,
                          const std::function<Result<>(const GridTriangleSpan&)>& sink) const;

 private:
  TriangleLists(InputFile file, const RecordFormat& format, std::vector<List> lists)
      : file_(std::move(file)), format_(format), lists_(std::move(lists)) {}
  // Appends triangles [first, first + count) of the list; `records` is overwritten.
  Result<> readSome(const List& list, uint64_t first, uint64_t count, std::vector<std::byte>& records,
                    GridTriangles& out) const;

  InputFile file_;
  RecordFormat format_;
  std::vector<List> lists_;
};

}  // namespace farcell
