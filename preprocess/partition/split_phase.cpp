#include "preprocess/partition/split_phase.h"

#include <atomic>
#include <thread>

#include "cache/base/interrupt.h"

namespace farcell {
namespace {

// Of a cell that is sorted again, and of one read.
constexpr size_t kSortBytes = size_t{4} << 20;
constexpr size_t kPortionBytes = size_t{1} << 18;

std::span<std::byte> portionOf(SplitMemory& memory) { return {memory.records.data(), kPortionBytes}; }

}  // namespace

// A cell whose octants are open.
struct SplitPhase::Division {
  CellKey key;
  std::shared_ptr<Division> parent;
  std::shared_ptr<const BucketFile> sortedAgain;  // made for this cell alone
  std::atomic<int> openOctants{8};
};

struct SplitPhase::Cell {
  CellKey key;
  std::shared_ptr<const BucketFile> file;  // holds the uncut triangles:
  size_t bucket;
  int level;  // from the root of the file's layout
  PolygonChain polygons;
  std::shared_ptr<Division> parent;

  size_t buckets() const { return file->layout().subtree(level); }
  uint64_t count() const { return file->triangles(bucket, buckets()); }
  uint64_t ownCount() const { return file->triangles(bucket, 1); }  // those that its planes cut
};

SplitPhase::SplitPhase(const std::filesystem::path& workDirectory, int gridBits, const SplitRule& rule,
                       LeafStore& leaves, Progress& progress)
    : workDirectory_(workDirectory), gridBits_(gridBits), rule_(rule), leaves_(leaves), progress_(progress) {}

SplitPhase::~SplitPhase() = default;

Result<> SplitPhase::run(std::shared_ptr<const BucketFile> spool, int threads) {
  progress_.begin("split", spool->triangles(0, spool->layout().count()), "triangles");
  std::vector<SplitMemory> memories(static_cast<size_t>(std::max(1, threads)));
  for (SplitMemory& memory : memories) {
    FARCELL_ASSIGN(memory, SplitMemory::create());
  }
  open_.push_back(Cell{CellKey{}, std::move(spool), 0, 0, {}, nullptr});
  {
    std::vector<std::jthread> helpers;
    for (size_t i = 1; i < memories.size(); ++i) helpers.emplace_back([this, &memories, i] { work(memories[i]); });
    work(memories[0]);
  }
  if (error_) return tl::unexpected<Error>(*error_);
  return {};
}

void SplitPhase::work(SplitMemory& memory) {
  std::unique_lock lock(mutex_);
  while (true) {
    changed_.wait(lock, [&] { return error_ || !open_.empty() || working_ == 0; });
    if (error_ || open_.empty()) return;
    ++working_;
    {
      const Cell cell = std::move(open_.back());
      open_.pop_back();
      lock.unlock();
      const Result<> done = process(cell, memory);
      lock.lock();
      if (!done && !error_) error_ = done.error();
    }
    --working_;
    changed_.notify_all();
  }
}

Result<> SplitPhase::process(const Cell& cell, SplitMemory& memory) {
  FARCELL_TRY(checkInterrupt());
  const uint64_t count = cell.count();
  if (leaves_.isFinished(cell.key) || (count == 0 && cell.polygons.count == 0)) {
    progress_.advance(count);
    return finished(cell.parent);
  }
  if (count * leaves_.format().bytes() <= SplitMemory::kRecordsBytes &&
      cell.polygons.bytes <= SplitMemory::kPolygonsBytes / 2) {
    FARCELL_ASSIGN(const bool done, splitInMemory(cell, memory));
    if (done) {
      progress_.advance(count);
      return finished(cell.parent);
    }
  }
  return divide(cell, memory);
}

Result<bool> SplitPhase::splitInMemory(const Cell& cell, SplitMemory& memory) {
  std::vector<uint32_t> starts;
  FARCELL_TRY(cell.file->read(cell.bucket, cell.buckets(), memory.records.data(), starts));
  PolygonList polygons;
  FARCELL_TRY(forEachPolygon(cell.polygons, [&](const GridPolygon& polygon) -> Result<> {
    polygons.add(polygon);
    return {};
  }));
  LeafWriter leaves(leaves_, {memory.leaves.data(), memory.leaves.sizeBytes()});
  CellSplitter splitter(gridBits_, rule_, leaves_.format(), memory, leaves);
  FARCELL_ASSIGN(const bool done,
                 splitter.split(cell.key, {&cell.file->layout(), starts, cell.level}, std::move(polygons)));
  if (done) FARCELL_TRY(leaves.finish(cell.key));
  return done;
}

Result<> SplitPhase::divide(Cell cell, SplitMemory& memory) {
  FARCELL_ASSIGN(const bool splits, shouldSplit(cell, memory));
  if (!splits) return writeLeaf(cell, memory);
  auto division = std::make_shared<Division>();
  division->key = cell.key;
  division->parent = cell.parent;
  if (cell.level == cell.file->layout().depth()) {
    FARCELL_ASSIGN(cell.file, sortAgain(cell, memory));
    cell.bucket = 0;
    cell.level = 0;
    division->sortedAgain = cell.file;
  }
  FARCELL_ASSIGN(const auto octants, cut(cell, memory));
  uint64_t pieces = cell.count() - cell.ownCount();
  for (const PolygonChain& octant : octants) pieces += octant.count;
  if (rule_.multiplies(cell.count() + cell.polygons.count, pieces)) {
    FARCELL_TRY(writeLeaf(cell, memory));
    return removeSortedAgain(*division);
  }
  progress_.advance(cell.ownCount());
  const std::lock_guard lock(mutex_);
  for (size_t octant = 8; octant-- > 0;)
    open_.push_back(Cell{cell.key.child(static_cast<uint32_t>(octant)), cell.file,
                         cell.file->layout().child(cell.bucket, cell.level, octant), cell.level + 1, octants[octant],
                         division});
  changed_.notify_all();
  return {};
}

Result<bool> SplitPhase::shouldSplit(const Cell& cell, SplitMemory& memory) const {
  const uint64_t triangles = cell.count() + cell.polygons.triangles;
  const SplitRule::Choice choice = rule_.choice(cell.key.level, triangles);
  if (choice != SplitRule::Choice::byArea) return choice == SplitRule::Choice::split;
  double area = 0;
  const auto addRecords = [&](std::span<const std::byte> records) -> Result<> {
    for (size_t at = 0; at < records.size(); at += leaves_.format().bytes())
      area += areaOf(cornersOf(records.data() + at));
    return {};
  };
  FARCELL_TRY(cell.file->forEachPortion(cell.bucket, cell.buckets(), portionOf(memory), addRecords));
  FARCELL_TRY(forEachPolygon(cell.polygons, [&](const GridPolygon& polygon) -> Result<> {
    area += areaOf(polygon);
    return {};
  }));
  return rule_.finerThanTexels(cell.key.level, triangles, area);
}

// A leaf of any size, from disk to disk.
Result<> SplitPhase::writeLeaf(const Cell& cell, SplitMemory& memory) {
  LeafWriter leaves(leaves_, {memory.leaves.data(), memory.leaves.sizeBytes()});
  FARCELL_TRY(leaves.begin(cell.key, cell.count() + cell.polygons.triangles));
  FARCELL_TRY(cell.file->forEachPortion(cell.bucket, cell.buckets(), portionOf(memory),
                                        [&](std::span<const std::byte> records) { return leaves.add(records); }));
  FARCELL_TRY(forEachPolygon(cell.polygons, [&](const GridPolygon& polygon) { return leaves.add(polygon); }));
  FARCELL_TRY(leaves.end());
  FARCELL_TRY(leaves.finish(cell.key));
  progress_.advance(cell.count());
  return finished(cell.parent);
}

// The triangles of a cell that lies at its file's deepest level, in a file of their own.
Result<std::shared_ptr<const BucketFile>> SplitPhase::sortAgain(const Cell& cell, SplitMemory& memory) const {
  const CellKey& key = cell.key;
  const int depth = std::min(BucketLayout::kMaxDepth, rule_.deepest() - static_cast<int>(key.level));
  const auto path = workDirectory_ / fmt::format("spool-{}-{}-{}-{}", key.level, key.x, key.y, key.z);
  FARCELL_ASSIGN(const auto builder, BucketBuilder::open(path, BucketLayout(key, gridBits_, depth), leaves_.format(),
                                                         {.portionBytes = kSortBytes}));
  uint64_t seen = 0;
  const auto put = [&](std::span<const std::byte> records) -> Result<> {
    const size_t bytes = leaves_.format().bytes();
    for (size_t at = 0; at < records.size(); at += bytes, ++seen) {
      if (seen < builder->sourceDone()) continue;
      if (builder->full()) FARCELL_TRY(builder->flush(seen));
      std::copy_n(records.data() + at, bytes, builder->slot());
      builder->take();
    }
    return checkInterrupt();
  };
  if (!builder->complete()) FARCELL_TRY(cell.file->forEachPortion(cell.bucket, 1, portionOf(memory), put));
  return builder->finish(seen);
}

Result<std::array<PolygonChain, 8>> SplitPhase::cut(const Cell& cell, SplitMemory& memory) const {
  std::array<PolygonChain, 8> chains;
  if (cell.ownCount() == 0 && cell.polygons.count == 0) return chains;
  FARCELL_ASSIGN(ScratchFile scratch, ScratchFile::create(workDirectory_));
  const auto file = std::make_shared<PolygonFile>(std::move(scratch));
  std::vector<ChainWriter> writers;
  for (size_t octant = 0; octant < 8; ++octant) writers.emplace_back(file);
  const GridPoint middle = middleOf(gridBits_, cell.key);
  OctantPolygons parts;
  const auto put = [&](const GridPolygon& polygon) -> Result<> {
    cutToOctants(polygon, middle, parts);
    for (size_t octant = 0; octant < 8; ++octant)
      if (parts[octant].count > 0) FARCELL_TRY(writers[octant].add(parts[octant]));
    return {};
  };
  const RecordFormat& format = leaves_.format();
  const auto putRecords = [&](std::span<const std::byte> records) -> Result<> {
    for (size_t at = 0; at < records.size(); at += format.bytes())
      FARCELL_TRY(put(polygonOf(format.triangle(records.data() + at), format.texture(records.data() + at))));
    return checkInterrupt();
  };
  FARCELL_TRY(cell.file->forEachPortion(cell.bucket, 1, portionOf(memory), putRecords));
  FARCELL_TRY(forEachPolygon(cell.polygons, put));
  for (size_t octant = 0; octant < 8; ++octant) {
    FARCELL_ASSIGN(chains[octant], writers[octant].finish());
  }
  return chains;
}

// An octant of the division is done; with the last of them, so is the divided cell.
Result<> SplitPhase::finished(std::shared_ptr<Division> division) {
  for (; division && --division->openOctants == 0; division = division->parent) {
    FARCELL_TRY(leaves_.finish(division->key, {}));
    FARCELL_TRY(removeSortedAgain(*division));
  }
  return {};
}

Result<> SplitPhase::removeSortedAgain(const Division& division) const {
  if (!division.sortedAgain) return {};
  const std::filesystem::path& path = division.sortedAgain->path();
  std::error_code error;
  if (!std::filesystem::remove(path, error) && error)
    return fail(ErrorKind::io, "{}: cannot remove: {}", path.string(), error.message());
  return {};
}

}  // namespace farcell
