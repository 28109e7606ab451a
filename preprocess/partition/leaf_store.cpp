#include "preprocess/partition/leaf_store.h"

#include <algorithm>
#include <cstring>
#include <tuple>

#include "cache/base/hash.h"

namespace farcell {
namespace {

constexpr size_t kVerifyBytes = size_t{1} << 18;

// Before the leaves of a journal's entry; after them stands the hash of both.
struct EntryHead {
  uint64_t leaves;
  CellKey cell;
};

bool byLevelThenMorton(const LeafRecord& a, const LeafRecord& b) {
  return std::tuple(a.key.level, mortonCode(a.key)) < std::tuple(b.key.level, mortonCode(b.key));
}

uint64_t entryHash(const EntryHead& head, std::span<const LeafRecord> leaves) {
  Hasher hasher;
  hasher.add(std::as_bytes(std::span(&head, 1)));
  hasher.add(std::as_bytes(leaves));
  return hasher.value();
}

}  // namespace

Result<std::unique_ptr<LeafStore>> LeafStore::open(const std::filesystem::path& data,
                                                   const std::filesystem::path& journal, const RecordFormat& format,
                                                   uint64_t maxLeaves) {
  FARCELL_ASSIGN(ScratchFile dataFile, ScratchFile::open(data));
  FARCELL_ASSIGN(ScratchFile journalFile, ScratchFile::open(journal));
  std::unique_ptr<LeafStore> store(new LeafStore(std::move(dataFile), std::move(journalFile), format, maxLeaves));
  FARCELL_TRY(store->resume());
  return store;
}

Result<> LeafStore::resume() {
  FARCELL_ASSIGN(const uint64_t journalBytes, journal_.sizeBytes());
  FARCELL_ASSIGN(const uint64_t dataBytes, data_.sizeBytes());
  while (true) {
    FARCELL_ASSIGN(const bool kept, keepEntry(journalBytes, dataBytes));
    if (!kept) break;
  }
  std::sort(finished_.begin(), finished_.end());
  FARCELL_TRY(journal_.truncate(journalEnd_));
  return data_.truncate(dataEnd_);
}

// Of the entry at the end: whether it and its leaves are whole, and then it is kept.
Result<bool> LeafStore::keepEntry(uint64_t journalBytes, uint64_t dataBytes) {
  EntryHead head;
  uint64_t hash = 0;
  const uint64_t room = journalBytes - journalEnd_;
  if (room < sizeof(head) + sizeof(hash)) return false;
  FARCELL_TRY(journal_.readAt(journalEnd_, std::as_writable_bytes(std::span(&head, 1))));
  if (head.leaves > (room - sizeof(head) - sizeof(hash)) / sizeof(LeafRecord)) return false;
  std::vector<LeafRecord> leaves(head.leaves);
  const auto bytes = std::as_writable_bytes(std::span(leaves));
  FARCELL_TRY(journal_.readAt(journalEnd_ + sizeof(head), bytes));
  FARCELL_TRY(journal_.readAt(journalEnd_ + sizeof(head) + bytes.size(), std::as_writable_bytes(std::span(&hash, 1))));
  if (hash != entryHash(head, leaves)) return false;
  for (const LeafRecord& leaf : leaves) {
    FARCELL_ASSIGN(const bool whole, isWhole(leaf, dataBytes));
    if (!whole) return false;
  }
  for (const LeafRecord& leaf : leaves)
    dataEnd_ = std::max(dataEnd_, leaf.offsetBytes + leaf.triangles * format_.bytes());
  leaves_.insert(leaves_.end(), leaves.begin(), leaves.end());
  finished_.push_back(head.cell);
  journalEnd_ += sizeof(head) + bytes.size() + sizeof(hash);
  return true;
}

Result<bool> LeafStore::isWhole(const LeafRecord& leaf, uint64_t dataBytes) const {
  if (leaf.offsetBytes > dataBytes || leaf.triangles > (dataBytes - leaf.offsetBytes) / format_.bytes()) return false;
  Hasher hasher;
  std::vector<std::byte> buffer(kVerifyBytes);
  const uint64_t size = leaf.triangles * format_.bytes();
  for (uint64_t at = 0; at < size; at += buffer.size()) {
    const std::span<std::byte> part = std::span(buffer).first(std::min<uint64_t>(buffer.size(), size - at));
    FARCELL_TRY(data_.readAt(leaf.offsetBytes + at, part));
    hasher.add(part);
  }
  return hasher.value() == leaf.hash;
}

uint64_t LeafStore::reserve(uint64_t bytes) {
  const std::lock_guard lock(mutex_);
  return std::exchange(dataEnd_, dataEnd_ + bytes);
}

Result<> LeafStore::write(uint64_t offset, std::span<const std::byte> records) {
  return data_.writeAt(offset, records);
}

Result<> LeafStore::finish(const CellKey& cell, std::span<const LeafRecord> leaves) {
  const EntryHead head{leaves.size(), cell};
  const uint64_t hash = entryHash(head, leaves);
  std::vector<std::byte> entry;
  const auto put = [&](std::span<const std::byte> bytes) { entry.insert(entry.end(), bytes.begin(), bytes.end()); };
  put(std::as_bytes(std::span(&head, 1)));
  put(std::as_bytes(leaves));
  put(std::as_bytes(std::span(&hash, 1)));
  const std::lock_guard lock(mutex_);
  if (leaves_.size() + leaves.size() > maxLeaves_)
    return fail(ErrorKind::exhausted,
                "memory: expected at most {} leaves, found more: allow more memory or larger leaves", maxLeaves_);
  FARCELL_TRY(journal_.writeAt(journalEnd_, entry));
  journalEnd_ += entry.size();
  leaves_.insert(leaves_.end(), leaves.begin(), leaves.end());
  return {};
}

bool LeafStore::isFinished(const CellKey& cell) const {
  return std::binary_search(finished_.begin(), finished_.end(), cell);
}

Result<std::vector<LeafRecord>> LeafStore::seal() {
  FARCELL_TRY(data_.sync());
  std::vector<LeafRecord> leaves(leaves_.begin(), leaves_.end());
  std::sort(leaves.begin(), leaves.end(), byLevelThenMorton);
  return leaves;
}

Result<> LeafWriter::begin(const CellKey& key, uint64_t maxTriangles) {
  const uint64_t maxBytes = maxTriangles * store_.format().bytes();
  if (maxBytes > buffer_.size() - used_) FARCELL_TRY(flush());
  leaf_ = {};
  leaf_.key = key;
  leafStart_ = used_;
  hasher_ = nullptr;
  if (maxBytes <= buffer_.size()) return {};
  hasher_ = std::make_unique<Hasher>();
  written_ = leaf_.offsetBytes = store_.reserve(maxBytes);
  return {};
}

Result<> LeafWriter::add(std::span<const std::byte> records) {
  for (size_t at = 0; at < records.size(); at += store_.format().bytes())
    for (const GridPoint& corner : cornersOf(records.data() + at)) leaf_.content.include(corner);
  leaf_.triangles += records.size() / store_.format().bytes();
  while (records.size() > buffer_.size() - used_) {
    const size_t part = buffer_.size() - used_;
    FARCELL_TRY(put(records.first(part)));
    records = records.subspan(part);
  }
  return put(records);
}

Result<> LeafWriter::add(const GridPolygon& polygon) {
  fan_.clear();
  appendTriangles(polygon, fan_);
  std::array<std::byte, sizeof(GridTriangle) + sizeof(TriangleTexture)> record;
  const GridTriangleSpan fan = fan_;
  for (size_t i = 0; i < fan.size(); ++i) {
    store_.format().put(fan.triangles[i], fan.texture(i), record.data());
    FARCELL_TRY(add(std::span(record).first(store_.format().bytes())));
  }
  return {};
}

// REQUIRES: records fit into the buffer.
Result<> LeafWriter::put(std::span<const std::byte> records) {
  std::copy(records.begin(), records.end(), buffer_.data() + used_);
  used_ += records.size();
  return used_ == buffer_.size() && hasher_ ? flush() : Result<>{};
}

Result<> LeafWriter::end() {
  if (hasher_) {
    FARCELL_TRY(flush());
    leaf_.hash = hasher_->value();
    hasher_ = nullptr;
  } else {
    leaf_.offsetBytes = leafStart_;
    leaf_.hash = hashBytes(buffer_.subspan(leafStart_, used_ - leafStart_));
    pending_ += leaf_.triangles > 0;
  }
  if (leaf_.triangles > 0) leaves_.push_back(leaf_);
  return {};
}

// Inside a large leaf, what is in the buffer belongs to it; else to the leaves that are pending.
Result<> LeafWriter::flush() {
  const std::span<const std::byte> records = buffer_.first(used_);
  used_ = 0;
  if (hasher_) {
    hasher_->add(records);
    FARCELL_TRY(store_.write(written_, records));
    written_ += records.size();
    return {};
  }
  const uint64_t place = store_.reserve(records.size());
  for (; pending_ > 0; --pending_) leaves_[leaves_.size() - pending_].offsetBytes += place;
  return store_.write(place, records);
}

Result<> LeafWriter::finish(const CellKey& cell) {
  FARCELL_TRY(flush());
  return store_.finish(cell, leaves_);
}

}  // namespace farcell
