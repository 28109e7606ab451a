#include "preprocess/partition/triangle_lists.h"

#include <algorithm>
#include <utility>

namespace farcell {

TriangleLists::TriangleLists(TriangleLists&& other) noexcept
    : file_(std::move(other.file_)), endBytes_(other.endBytes_), lists_(std::move(other.lists_)) {}

Result<TriangleLists> TriangleLists::create(const std::filesystem::path& scratchDirectory, size_t listCount) {
  FARCELL_ASSIGN(ScratchFile file, ScratchFile::create(scratchDirectory));
  TriangleLists lists(std::move(file));
  lists.lists_.resize(listCount);
  return lists;
}

size_t TriangleLists::addList() {
  const std::lock_guard lock(mutex_);
  lists_.emplace_back();
  return lists_.size() - 1;
}

Result<> TriangleLists::append(size_t list, std::span<const GridTriangle> triangles) {
  if (triangles.empty()) return {};
  uint64_t offset = 0;
  {
    const std::lock_guard lock(mutex_);
    offset = endBytes_;
    endBytes_ += triangles.size_bytes();
    lists_[list].runs.push_back({offset, triangles.size()});
    lists_[list].size += triangles.size();
  }
  return file_.writeAt(offset, std::as_bytes(triangles));
}

Result<std::vector<GridTriangle>> TriangleLists::read(size_t list) const {
  std::vector<GridTriangle> triangles(lists_[list].size);
  size_t done = 0;
  for (const Run& run : lists_[list].runs) {
    FARCELL_TRY(file_.readAt(run.offsetBytes, std::as_writable_bytes(std::span(triangles).subspan(done, run.size))));
    done += run.size;
  }
  return triangles;
}

Result<> TriangleLists::forEachPortion(size_t list, size_t portion,
                                       const std::function<Result<>(std::span<const GridTriangle>)>& sink) const {
  std::vector<GridTriangle> buffer;
  for (const Run& run : lists_[list].runs) {
    for (uint64_t first = 0; first < run.size; first += portion) {
      buffer.resize(std::min<uint64_t>(portion, run.size - first));
      FARCELL_TRY(
          file_.readAt(run.offsetBytes + first * sizeof(GridTriangle), std::as_writable_bytes(std::span(buffer))));
      FARCELL_TRY(sink(buffer));
    }
  }
  return {};
}

}  // namespace farcell
