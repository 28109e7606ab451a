// What every job of a build shares.
#pragma once

#include <atomic>
#include <chrono>
#include <vector>

#include "cache/schema/viewpoints.h"
#include "preprocess/build/cell_store.h"
#include "preprocess/build/cell_tree.h"
#include "preprocess/build/memory_gate.h"
#include "preprocess/choose/visitable.h"
#include "preprocess/mesh/texture_sampler.h"

namespace farcell {

// Seconds of work, of all threads.
struct WorkClock {
  std::atomic<int64_t> meshNs{0}, bakeNs{0}, encodeNs{0};
};

// Adds what passes until its end to a clock.
class Lap {
 public:
  explicit Lap(std::atomic<int64_t>& sum) : sum_(sum) {}
  Lap(const Lap&) = delete;
  Lap& operator=(const Lap&) = delete;
  ~Lap() {
    sum_ += std::chrono::duration_cast<std::chrono::nanoseconds>(std::chrono::steady_clock::now() - start_).count();
  }

 private:
  std::atomic<int64_t>& sum_;
  const std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

struct BuildContext {
  const Model& model;
  const CellTree& tree;
  const Partition& partition;
  const Viewpoints& viewpoints;
  const std::vector<ViewMask>& seen;  // by cell, the views that a visitor may get; empty: all
  bool hasTextures;
  CellStore& store;
  MemoryGate& gate;
  uint64_t memoryOfThread;  // share of the gate that one thread should stay within, where it has the choice
  WorkClock& clock;

  bool wanted(uint32_t cell, int view) const { return seen.empty() || seen[cell][static_cast<size_t>(view)]; }
};

}  // namespace farcell
