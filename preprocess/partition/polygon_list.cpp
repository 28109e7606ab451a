#include "preprocess/partition/polygon_list.h"

#include <cstring>
#include <utility>

namespace farcell {
namespace {

// Before the polygons of a block.
struct BlockHead {
  uint64_t next;
  uint64_t usedBytes;
};

}  // namespace

void packPolygon(const GridPolygon& polygon, std::byte* out) {
  std::memcpy(out, &polygon.count, sizeof(polygon.count));
  std::memcpy(out + sizeof(polygon.count), &polygon.texture, sizeof(polygon.texture));
  const size_t head = sizeof(polygon.count) + sizeof(polygon.texture);
  std::memcpy(out + head, polygon.corners.data(), packedBytes(polygon) - head);
}

GridPolygon unpackPolygon(const std::byte* packed) {
  GridPolygon polygon;
  std::memcpy(&polygon.count, packed, sizeof(polygon.count));
  std::memcpy(&polygon.texture, packed + sizeof(polygon.count), sizeof(polygon.texture));
  const size_t head = sizeof(polygon.count) + sizeof(polygon.texture);
  std::memcpy(polygon.corners.data(), packed + head, packedBytes(polygon) - head);
  return polygon;
}

void PolygonList::add(const GridPolygon& polygon) {
  const size_t at = bytes_.size();
  bytes_.resize(at + packedBytes(polygon));
  packPolygon(polygon, bytes_.data() + at);
  ++count_;
  triangles_ += static_cast<size_t>(polygon.count - 2);
}

Result<> forEachPolygon(const PolygonChain& chain, const std::function<Result<>(const GridPolygon&)>& sink) {
  std::vector<std::byte> buffer;
  uint64_t block = chain.firstBlock;
  for (uint64_t left = chain.count; left > 0;) {
    BlockHead head;
    FARCELL_TRY(chain.file->file_.readAt(block, std::as_writable_bytes(std::span(&head, 1))));
    buffer.resize(head.usedBytes);
    FARCELL_TRY(chain.file->file_.readAt(block + sizeof(head), buffer));
    for (size_t at = 0; at < buffer.size(); --left) {
      const GridPolygon polygon = unpackPolygon(buffer.data() + at);
      at += packedBytes(polygon);
      FARCELL_TRY(sink(polygon));
    }
    block = head.next;
  }
  return {};
}

ChainWriter::ChainWriter(std::shared_ptr<PolygonFile> file) : file_(std::move(file)) {
  chain_.file = file_;
  chain_.firstBlock = block_ = std::exchange(file_->endBytes_, file_->endBytes_ + PolygonFile::kBlockBytes);
}

Result<> ChainWriter::add(const GridPolygon& polygon) {
  const size_t bytes = packedBytes(polygon);
  if (buffer_.size() + bytes > PolygonFile::kBlockBytes) FARCELL_TRY(flush());
  if (buffer_.empty()) buffer_.resize(sizeof(BlockHead));
  const size_t at = buffer_.size();
  buffer_.resize(at + bytes);
  packPolygon(polygon, buffer_.data() + at);
  ++chain_.count;
  chain_.triangles += static_cast<uint64_t>(polygon.count - 2);
  chain_.bytes += bytes;
  return {};
}

Result<> ChainWriter::flush() {
  if (buffer_.empty()) return {};
  const uint64_t next = std::exchange(file_->endBytes_, file_->endBytes_ + PolygonFile::kBlockBytes);
  const BlockHead head{next, buffer_.size() - sizeof(BlockHead)};
  std::memcpy(buffer_.data(), &head, sizeof(head));
  FARCELL_TRY(file_->file_.writeAt(block_, buffer_));
  block_ = next;
  buffer_.clear();
  return {};
}

Result<PolygonChain> ChainWriter::finish() {
  FARCELL_TRY(flush());
  return chain_;
}

}  // namespace farcell
