// Where the split puts leaves: their triangles in a data file, and in a journal which cells are done with which leaves.
//
// A cell enters the journal after its triangles are in the data file; each entry has a checksum, each leaf one of its
// triangles. After a crash, whatever of the journal and of the data is whole is kept: a killed process loses the cells
// it was working on, a loss of power those that had not reached the disk.
#pragma once

#include <deque>
#include <filesystem>
#include <memory>
#include <mutex>
#include <span>
#include <vector>

#include "cache/base/file.h"
#include "cache/base/hash.h"
#include "cache/schema/grid.h"
#include "preprocess/partition/polygon_list.h"
#include "preprocess/partition/record_format.h"

namespace farcell {

struct LeafRecord {
  CellKey key;
  GridBox content;
  uint64_t offsetBytes = 0;
  uint64_t triangles = 0;
  uint64_t hash = 0;  // of its records
};

class LeafStore {
 public:
  // maxLeaves: more are an error, as their table must stay in memory.
  static Result<std::unique_ptr<LeafStore>> open(const std::filesystem::path& data,
                                                 const std::filesystem::path& journal, const RecordFormat& format,
                                                 uint64_t maxLeaves);

  // Any thread:
  const RecordFormat& format() const { return format_; }
  // A place of so many bytes in the data file.
  uint64_t reserve(uint64_t bytes);
  Result<> write(uint64_t offset, std::span<const std::byte> records);
  // The cell and all below it are done; these are the leaves that were not in the journal yet.
  Result<> finish(const CellKey& cell, std::span<const LeafRecord> leaves);
  bool isFinished(const CellKey& cell) const;

  // Once all is done: the data is safe from a loss of power; all leaves, by level, then Morton code.
  Result<std::vector<LeafRecord>> seal();

 private:
  LeafStore(ScratchFile data, ScratchFile journal, const RecordFormat& format, uint64_t maxLeaves)
      : format_(format), maxLeaves_(maxLeaves), data_(std::move(data)), journal_(std::move(journal)) {}
  Result<> resume();
  Result<bool> keepEntry(uint64_t journalBytes, uint64_t dataBytes);
  Result<bool> isWhole(const LeafRecord& leaf, uint64_t dataBytes) const;

  const RecordFormat format_;
  const uint64_t maxLeaves_;
  ScratchFile data_;
  ScratchFile journal_;
  mutable std::mutex mutex_;
  // Guarded by mutex_:
  uint64_t dataEnd_ = 0;
  uint64_t journalEnd_ = 0;
  std::vector<CellKey> finished_;  // those that an earlier run left, in order
  std::deque<LeafRecord> leaves_;
};

// Writes the leaves of one cell, from one thread: small ones together, large ones as they come.
class LeafWriter {
 public:
  static constexpr size_t kBufferBytes = size_t{1} << 20;
  // buffer: kBufferBytes that nobody else uses meanwhile.
  LeafWriter(LeafStore& store, std::span<std::byte> buffer) : store_(store), buffer_(buffer) {}

  // A leaf's triangles: begin, then add any number of times, then end. maxTriangles: no more will be added.
  Result<> begin(const CellKey& key, uint64_t maxTriangles);
  Result<> add(std::span<const std::byte> records);
  Result<> add(const GridPolygon& polygon);
  Result<> end();
  // A leaf without triangles is none. All are in the data file after finish().
  Result<> finish(const CellKey& cell);

 private:
  Result<> flush();
  Result<> put(std::span<const std::byte> records);

  LeafStore& store_;
  std::span<std::byte> buffer_;
  size_t used_ = 0;
  LeafRecord leaf_;       // begun, not ended
  size_t leafStart_ = 0;  // in the buffer
  // Set where the leaf does not fit into the buffer: how far it is written, and its checksum up to there.
  std::unique_ptr<Hasher> hasher_;
  uint64_t written_ = 0;
  GridTriangles fan_;
  std::vector<LeafRecord> leaves_;
  size_t pending_ = 0;  // so many of the last leaves lie in the buffer, and offsetBytes counts from its start
};

}  // namespace farcell
