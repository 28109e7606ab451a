// What every job of a build shares.
#pragma once

#include <time.h>

#include <atomic>
#include <vector>

#include "cache/schema/viewpoints.h"
#include "preprocess/build/cell_store.h"
#include "preprocess/build/cell_tree.h"
#include "preprocess/build/memory_gate.h"
#include "preprocess/choose/visitable.h"
#include "preprocess/mesh/texture_sampler.h"

namespace farcell {

// Processor time of all threads, by kind of work.
struct WorkClock {
  std::atomic<int64_t> meshNs{0}, bakeNs{0}, encodeNs{0}, measureNs{0};
};

// Adds the processor time that this thread uses while it lives to a sum.
class Lap {
 public:
  explicit Lap(std::atomic<int64_t>& sum) : sum_(sum) {}
  Lap(const Lap&) = delete;
  Lap& operator=(const Lap&) = delete;
  ~Lap() { sum_ += threadNs() - start_; }

 private:
  static int64_t threadNs() {
    timespec now{};
    ::clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
    return int64_t{now.tv_sec} * 1'000'000'000 + now.tv_nsec;
  }

  std::atomic<int64_t>& sum_;
  const int64_t start_ = threadNs();
};

struct BuildContext {
  const Model& model;
  const CellTree& tree;
  const Partition& partition;
  const std::vector<ViewMask>& seen;  // by cell, the views that a visitor can get; empty: all
  bool hasTextures;
  CellStore& store;
  MemoryGate& gate;
  uint64_t memoryOfThread;  // share of the gate that one thread should stay within, where it has the choice
  WorkClock& clock;

  const ViewForm& form(uint32_t cell) const { return tree.cells[cell].form; }
  const Viewpoints& viewpoints(uint32_t cell) const { return Viewpoints::of(form(cell).views); }
  bool wanted(uint32_t cell, int view) const { return seen.empty() || seen[cell][static_cast<size_t>(view)]; }
};

}  // namespace farcell
