#include "preprocess/partition/triangle_lists.h"

#include <algorithm>
#include <utility>

namespace farcell {
namespace {
constexpr uint64_t kReadTriangles = 4096;  // records at a time: still in the cache when they are unpacked
}  // namespace

Result<TriangleLists> TriangleLists::open(const std::filesystem::path& path, const RecordFormat& format,
                                          std::vector<List> lists) {
  FARCELL_ASSIGN(InputFile file, InputFile::open(path));
  for (const List& list : lists)
    if (list.offsetBytes > file.sizeBytes() || list.size > (file.sizeBytes() - list.offsetBytes) / format.bytes())
      return corrupt(file.path(), list.offsetBytes, fmt::format("{} triangles", list.size),
                     fmt::format("a file of {} bytes", file.sizeBytes()));
  return TriangleLists(std::move(file), format, std::move(lists));
}

Result<> TriangleLists::readSome(const List& list, uint64_t first, uint64_t count, std::vector<std::byte>& records,
                                 GridTriangles& out) const {
  const size_t bytes = format_.bytes();
  for (uint64_t at = first; at < first + count; at += kReadTriangles) {
    records.resize(std::min(kReadTriangles, first + count - at) * bytes);
    FARCELL_TRY(file_.readAt(list.offsetBytes + at * bytes, records));
    for (size_t record = 0; record < records.size(); record += bytes)
      out.add(format_.triangle(records.data() + record), format_.texture(records.data() + record));
  }
  return {};
}

Result<GridTriangles> TriangleLists::read(size_t list) const {
  GridTriangles triangles;
  triangles.triangles.reserve(lists_[list].size);
  std::vector<std::byte> records;
  FARCELL_TRY(readSome(lists_[list], 0, lists_[list].size, records, triangles));
  return triangles;
}

Result<> TriangleLists::forEachPortion(size_t list, size_t portion,
                                       const std::function<Result<>(const GridTriangleSpan&)>& sink) const {
  GridTriangles buffer;
  std::vector<std::byte> records;
  const uint64_t size = lists_[list].size;
  for (uint64_t first = 0; first < size; first += portion) {
    buffer.clear();
    FARCELL_TRY(readSome(lists_[list], first, std::min<uint64_t>(portion, size - first), records, buffer));
    FARCELL_TRY(sink(buffer));
  }
  return {};
}

}  // namespace farcell
