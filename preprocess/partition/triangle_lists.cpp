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

Result<> TriangleLists::append(size_t list, const GridTriangleSpan& triangles) {
  if (triangles.size() == 0) return {};
  uint64_t offset = 0;
  {
    const std::lock_guard lock(mutex_);
    offset = endBytes_;
    endBytes_ += triangles.triangles.size_bytes() + triangles.textures.size_bytes();
    lists_[list].runs.push_back({offset, triangles.size(), !triangles.textures.empty()});
    lists_[list].size += triangles.size();
  }
  FARCELL_TRY(file_.writeAt(offset, std::as_bytes(triangles.triangles)));
  return file_.writeAt(offset + triangles.triangles.size_bytes(), std::as_bytes(triangles.textures));
}

Result<> TriangleLists::readRun(const Run& run, uint64_t first, uint64_t count, GridTriangles& out) const {
  const size_t before = out.size();
  out.triangles.resize(before + count);
  FARCELL_TRY(file_.readAt(run.offsetBytes + first * sizeof(GridTriangle),
                           std::as_writable_bytes(std::span(out.triangles).subspan(before))));
  if (!run.textured && out.textures.empty()) return {};
  out.textures.resize(before + count);
  if (!run.textured) return {};
  return file_.readAt(run.offsetBytes + run.size * sizeof(GridTriangle) + first * sizeof(TriangleTexture),
                      std::as_writable_bytes(std::span(out.textures).subspan(before)));
}

Result<GridTriangles> TriangleLists::read(size_t list) const {
  GridTriangles triangles;
  triangles.triangles.reserve(lists_[list].size);
  for (const Run& run : lists_[list].runs) FARCELL_TRY(readRun(run, 0, run.size, triangles));
  return triangles;
}

Result<> TriangleLists::forEachPortion(size_t list, size_t portion,
                                       const std::function<Result<>(const GridTriangleSpan&)>& sink) const {
  GridTriangles buffer;
  for (const Run& run : lists_[list].runs) {
    for (uint64_t first = 0; first < run.size; first += portion) {
      buffer.clear();
      FARCELL_TRY(readRun(run, first, std::min<uint64_t>(portion, run.size - first), buffer));
      FARCELL_TRY(sink(buffer));
    }
  }
  return {};
}

}  // namespace farcell
