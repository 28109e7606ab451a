// Lists of cut polygons, in memory and in scratch: packed, as most polygons have three or four corners of twelve.
#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "cache/base/file.h"
#include "preprocess/partition/grid_triangle.h"

namespace farcell {

// Bytes of a packed polygon: count, texture and the corners in use.
inline size_t packedBytes(const GridPolygon& polygon) {
  return sizeof(polygon.count) + sizeof(polygon.texture) + static_cast<size_t>(polygon.count) * sizeof(GridCorner);
}
void packPolygon(const GridPolygon& polygon, std::byte* out);
GridPolygon unpackPolygon(const std::byte* packed);

class PolygonList {
 public:
  void add(const GridPolygon& polygon);
  size_t count() const { return count_; }
  size_t triangles() const { return triangles_; }  // with those that will turn out degenerate
  size_t bytes() const { return bytes_.size(); }
  template <class Sink>
  void forEach(const Sink& sink) const {
    for (size_t at = 0; at < bytes_.size();) {
      const GridPolygon polygon = unpackPolygon(bytes_.data() + at);
      at += packedBytes(polygon);
      sink(polygon);
    }
  }

 private:
  std::vector<std::byte> bytes_;
  size_t count_ = 0;
  size_t triangles_ = 0;
};

// A list in scratch: blocks of which each names the next. Nothing of it stays in memory.
class PolygonFile;
struct PolygonChain {
  std::shared_ptr<const PolygonFile> file;
  uint64_t firstBlock = 0;
  uint64_t count = 0;
  uint64_t triangles = 0;
  uint64_t bytes = 0;
};
Result<> forEachPolygon(const PolygonChain& chain, const std::function<Result<>(const GridPolygon&)>& sink);

class PolygonFile {
 public:
  static constexpr size_t kBlockBytes = size_t{1} << 16;
  explicit PolygonFile(ScratchFile file) : file_(std::move(file)) {}

 private:
  friend class ChainWriter;
  friend Result<> forEachPolygon(const PolygonChain&, const std::function<Result<>(const GridPolygon&)>&);
  ScratchFile file_;
  uint64_t endBytes_ = 0;
};

// Writes one chain; several in turn may write to a file, from one thread.
class ChainWriter {
 public:
  explicit ChainWriter(std::shared_ptr<PolygonFile> file);
  Result<> add(const GridPolygon& polygon);
  Result<PolygonChain> finish();

 private:
  Result<> flush();
  std::shared_ptr<PolygonFile> file_;
  PolygonChain chain_;
  uint64_t block_;
  std::vector<std::byte> buffer_;
};

}  // namespace farcell
