// From the spool to leaves: cells that fit in a thread's memory are split there; of others, on disk, the triangles that
// their planes cut, and the octants are taken up in turn. All threads work on whatever cells are open.
#pragma once

#include <condition_variable>
#include <mutex>
#include <optional>
#include <vector>

#include "cache/base/progress.h"
#include "preprocess/partition/bucket_file.h"
#include "preprocess/partition/cell_splitter.h"

namespace farcell {

class SplitPhase {
 public:
  SplitPhase(const std::filesystem::path& workDirectory, int gridBits, const SplitRule& rule, LeafStore& leaves,
             Progress& progress);
  ~SplitPhase();

  // Every cell that is not in the journal of `leaves` yet.
  Result<> run(std::shared_ptr<const BucketFile> spool, int threads);

 private:
  struct Division;
  struct Cell;
  void work(SplitMemory& memory);
  Result<> process(const Cell& cell, SplitMemory& memory);
  Result<bool> splitInMemory(const Cell& cell, SplitMemory& memory);
  Result<> divide(Cell cell, SplitMemory& memory);
  Result<bool> shouldSplit(const Cell& cell, SplitMemory& memory) const;
  Result<> writeLeaf(const Cell& cell, SplitMemory& memory);
  Result<std::shared_ptr<const BucketFile>> sortAgain(const Cell& cell, SplitMemory& memory) const;
  Result<std::array<PolygonChain, 8>> cut(const Cell& cell, SplitMemory& memory) const;
  Result<> finished(std::shared_ptr<Division> division);
  Result<> removeSortedAgain(const Division& division) const;

  const std::filesystem::path workDirectory_;
  const int gridBits_;
  const SplitRule rule_;
  LeafStore& leaves_;
  Progress& progress_;
  std::mutex mutex_;
  // Guarded by mutex_:
  std::condition_variable changed_;
  std::vector<Cell> open_;  // the last is taken first: few stay open
  int working_ = 0;
  std::optional<Error> error_;
};

}  // namespace farcell
