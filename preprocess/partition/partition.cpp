#include "preprocess/partition/partition.h"

#include <algorithm>
#include <chrono>

#include "cache/base/sealed_file.h"
#include "preprocess/partition/split_phase.h"
#include "preprocess/partition/spool.h"

namespace farcell {
namespace {

constexpr uint64_t kIndexMagic = 0x31786564'6e697470;  // "ptindex1"

struct WorkFiles {
  explicit WorkFiles(const std::filesystem::path& directory)
      : measure(directory / "measure"),
        spool(directory / "spool"),
        leaves(directory / "leaves"),
        journal(directory / "journal"),
        index(directory / "index") {}
  std::filesystem::path measure, spool, leaves, journal, index;
};

double secondsSince(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

// How a ceiling is shared out.
struct Shares {
  uint64_t spoolBytes;
  int splitThreads;
  uint64_t maxLeaves;
};

Result<Shares> shareOut(const PartitionOptions& options) {
  const uint64_t memory = options.memoryBytes;
  if (memory < kMinPartitionMemoryBytes)
    return fail(ErrorKind::exhausted, "memory: expected at least {} bytes for the partition, found {}",
                kMinPartitionMemoryBytes, memory);
  // A quarter is the leaves' table, of which there are several while it is sealed and the split's memory is free again.
  const uint64_t atOnce = memory / 4 * 3 / SplitMemory::kTotalBytes;
  return Shares{memory / 8 * 7, static_cast<int>(std::clamp<uint64_t>(atOnce, 1, std::max(1, options.threads))),
                memory / (4 * sizeof(LeafRecord))};
}

struct Index {
  Grid grid;
  GridBox bounds;
  MeshCounts counts;
  RecordFormat format;
  std::vector<LeafRecord> leaves;
};

Result<> writeIndex(const std::filesystem::path& path, const Index& index) {
  SealedWriter writer;
  writer.put(kIndexMagic);
  writer.put(index.grid);
  writer.put(index.bounds);
  putCounts(writer, index.counts);
  writer.put(index.format);
  writer.put(uint64_t{index.leaves.size()});
  for (const LeafRecord& leaf : index.leaves) writer.put(leaf);
  return writer.commit(path);
}

std::optional<Index> readIndex(const std::filesystem::path& path) {
  std::optional<SealedReader> reader = SealedReader::open(path);
  Index index;
  uint64_t magic = 0, leaves = 0;
  if (!reader || !reader->get(magic) || magic != kIndexMagic) return std::nullopt;
  if (!reader->get(index.grid) || !reader->get(index.bounds) || !getCounts(*reader, index.counts) ||
      !reader->get(index.format) || !reader->get(leaves))
    return std::nullopt;
  for (LeafRecord leaf; leaves > 0; --leaves) {
    if (!reader->get(leaf)) return std::nullopt;
    index.leaves.push_back(leaf);
  }
  return index;
}

Result<Partition> partitionOf(Index index, const std::filesystem::path& data) {
  std::vector<Leaf> leaves;
  std::vector<TriangleLists::List> lists;
  leaves.reserve(index.leaves.size());
  lists.reserve(index.leaves.size());
  for (const LeafRecord& leaf : index.leaves) {
    leaves.push_back({leaf.key, leaf.content, lists.size()});
    lists.push_back({leaf.offsetBytes, leaf.triangles});
  }
  FARCELL_ASSIGN(TriangleLists triangles, TriangleLists::open(data, index.format, std::move(lists)));
  return Partition{index.grid, index.bounds, std::move(index.counts), std::move(leaves), std::move(triangles)};
}

// What the finished partition does not need. A directory that cannot be changed keeps it.
void removeScratch(const std::filesystem::path& directory) {
  std::error_code ignored;
  for (const auto& entry : std::filesystem::directory_iterator(directory, ignored)) {
    const std::string name = entry.path().filename().string();
    if (name == "measure" || name == "journal" || name.starts_with("spool"))
      std::filesystem::remove(entry.path(), ignored);
  }
}

}  // namespace

Result<std::optional<Partition>> loadPartition(const std::filesystem::path& workDirectory) {
  const WorkFiles files(workDirectory);
  std::optional<Index> index = readIndex(files.index);
  if (!index) return std::nullopt;
  FARCELL_ASSIGN(Partition partition, partitionOf(*std::move(index), files.leaves));
  return partition;
}

Result<Partition> partitionMesh(MeshReader& mesh, const BuildSettings& settings, const PartitionOptions& options,
                                Progress& progress) {
  FARCELL_ASSIGN(const Shares shares, shareOut(options));
  FARCELL_ASSIGN(std::optional<Partition> finished, loadPartition(options.workDirectory));
  if (finished) {
    removeScratch(options.workDirectory);
    return *std::move(finished);
  }
  const WorkFiles files(options.workDirectory);
  FARCELL_ASSIGN(MeshMeasure measure, measureMesh(mesh, settings, files.measure, progress));
  Index index{measure.grid, {}, std::move(measure.counts), recordFormatOf(mesh), {}};
  const SplitRule rule(settings, index.grid.bits);
  const int depth = std::min(BucketLayout::kMaxDepth, rule.deepest());
  FARCELL_ASSIGN(std::shared_ptr<const BucketFile> spool,
                 spoolMesh(mesh, index.grid, index.counts.accepted,
                           {files.spool, depth, options.threads, shares.spoolBytes}, progress));
  index.bounds = spool->box();
  if (index.bounds.empty())
    return fail(ErrorKind::corrupt, "expected a triangle wider than {} of the model's extent, found none",
                1.0 / (int64_t{1} << index.grid.bits));
  const auto start = std::chrono::steady_clock::now();
  {
    FARCELL_ASSIGN(const auto leaves, LeafStore::open(files.leaves, files.journal, index.format, shares.maxLeaves));
    FARCELL_TRY(SplitPhase(options.workDirectory, index.grid.bits, rule, *leaves, progress)
                    .run(std::move(spool), shares.splitThreads));
    FARCELL_ASSIGN(index.leaves, leaves->seal());
  }
  FARCELL_TRY(writeIndex(files.index, index));
  removeScratch(options.workDirectory);
  FARCELL_ASSIGN(Partition partition, partitionOf(std::move(index), files.leaves));
  partition.splitSeconds = secondsSince(start);
  return partition;
}

uint64_t scratchBytesEstimate(const MeshInfo& info, bool textured) {
  const uint64_t records = info.declaredTriangles * RecordFormat{info.hasColours, info.hasNormals, textured}.bytes();
  // The spool with its tables, and the leaves with what the cuts add.
  return (uint64_t{1} << 20) + records + records / 25 + records + records / 8;
}

}  // namespace farcell
