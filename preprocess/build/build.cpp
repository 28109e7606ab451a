#include "preprocess/build/build.h"

#include <chrono>
#include <cmath>
#include <cstdlib>
#include <utility>
#include <vector>

#include "cache/base/parallel.h"
#include "cache/pack/pack_file.h"
#include "preprocess/build/cell_bake.h"
#include "preprocess/build/ordered_output.h"
#include "preprocess/mesh/source_hash.h"
#include "preprocess/partition/partition.h"
#include "preprocess/read/open_mesh.h"
#include "preprocess/texture/textures.h"

namespace farcell {
namespace {

constexpr size_t kCellsAhead = 256;  // finished cells that may wait for a slower one

double secondsSince(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

constexpr uint64_t kPartitionMemoryBytes = uint64_t{1} << 30;

// A directory of this build alone, gone with it.
class WorkDirectory {
 public:
  static Result<WorkDirectory> create(const std::filesystem::path& parent) {
    std::string name = (parent / "farcell-work.XXXXXX").string();
    if (::mkdtemp(name.data()) == nullptr)
      return fail(ErrorKind::io, "{}: cannot create a directory in it", parent.string());
    return WorkDirectory(name);
  }
  WorkDirectory(WorkDirectory&& other) noexcept : path_(std::exchange(other.path_, {})) {}
  ~WorkDirectory() {
    std::error_code ignored;
    if (!path_.empty()) std::filesystem::remove_all(path_, ignored);
  }
  const std::filesystem::path& path() const { return path_; }

 private:
  explicit WorkDirectory(std::filesystem::path path) : path_(std::move(path)) {}
  std::filesystem::path path_;
};

// Adds a finished cell to the pack and to the report.
Result<> writeCell(uint32_t cell, const CellPages& pages, PackWriter& writer, Directory& directory) {
  CellRecord& record = directory.cells[cell];
  BuildReport& report = directory.report;
  for (const EncodedPage& page : pages.pages) {
    FARCELL_ASSIGN(const uint32_t index, writer.add(page.kind, cell, page.group, page.decodedBytes, page.bytes));
    if (page.kind == PageKind::geometry) {
      record.geometryPage = index;
      report.geometryBytes += page.bytes.size();
      continue;
    }
    if (record.viewPageCount++ == 0) record.firstViewPage = index;
    report.impostorBytes += page.bytes.size();
  }
  report.viewsBaked += pages.viewsBaked;
  report.viewsKept += pages.viewsKept;
  report.impostorRawBytes += pages.impostorRawBytes;
  if (pages.viewsEmpty > 0) report.viewsLeftOut["empty"] += pages.viewsEmpty;
  if (pages.viewsCheaperAsTriangles > 0) report.viewsLeftOut["cheaperAsTriangles"] += pages.viewsCheaperAsTriangles;
  return {};
}

// One for each thread; nulls when the mesh has no textures.
std::vector<std::unique_ptr<TextureSampler>> samplersOf(const Textures& textures, int threads) {
  std::vector<std::unique_ptr<TextureSampler>> samplers(static_cast<size_t>(threads));
  for (auto& sampler : samplers)
    if (textures.count() > 0) sampler = textures.sampler();
  return samplers;
}

// Bakes and writes every cell; shares the stage's wall time between bake and encode.
Result<> bakeCells(const CellTree& tree, const Partition& partition, const Textures& textures, int threads,
                   PackWriter& writer, Directory& directory, StageSeconds& seconds, Progress& progress) {
  FARCELL_ASSIGN(const Viewpoints viewpoints, Viewpoints::create(directory.model.settings.views));
  const auto start = std::chrono::steady_clock::now();
  double bake = 0, encode = 0;
  progress.begin("bake", tree.cells.size() * static_cast<uint64_t>(viewpoints.count()), "views");
  OrderedOutput<CellPages> output(kCellsAhead, [&](size_t cell, CellPages&& pages) {
    bake += pages.bakeSeconds;
    encode += pages.encodeSeconds;
    return writeCell(static_cast<uint32_t>(cell), pages, writer, directory);
  });
  const auto samplers = samplersOf(textures, threads);
  parallelFor(tree.cells.size(), threads, [&](size_t cell, int worker) {
    if (output.failed()) return;
    TextureSampler* sampler = samplers[static_cast<size_t>(worker)].get();
    output.put(cell, bakeCell(static_cast<uint32_t>(cell), directory.model, tree, partition, viewpoints, sampler));
    progress.advance(static_cast<uint64_t>(viewpoints.count()));
  });
  FARCELL_TRY(output.result());
  const double wall = secondsSince(start);
  const double work = std::max(bake + encode, 1e-9);
  seconds.bake = wall * bake / work;
  seconds.encode = wall * encode / work;
  return {};
}

}  // namespace

Result<> checkSettings(const BuildSettings& settings) {
  FARCELL_TRY(Viewpoints::create(settings.views));
  const auto range = [](const char* name, int value, int min, int max) -> Result<> {
    if (value >= min && value <= max) return {};
    return fail(ErrorKind::invalidArgument, "{}: expected {} to {}, found {}", name, min, max, value);
  };
  FARCELL_TRY(range("image-size", settings.imageSize, 16, 1024));
  if ((settings.imageSize & (settings.imageSize - 1)) != 0)
    return fail(ErrorKind::invalidArgument, "image-size: expected a power of two, found {}", settings.imageSize);
  if (settings.samples != 1 && settings.samples != 4 && settings.samples != 16 && settings.samples != 64)
    return fail(ErrorKind::invalidArgument, "samples: expected 1, 4, 16 or 64, found {}", settings.samples);
  FARCELL_TRY(range("leaf-triangles", settings.leafTriangles, 64, 1 << 24));
  FARCELL_TRY(range("max-level", settings.maxLevel, 0, kMaxLevel));
  FARCELL_TRY(range("fixed-level", settings.fixedLevel, -1, settings.maxLevel));
  if (!(settings.metresPerUnit > 0 && std::isfinite(settings.metresPerUnit)))
    return fail(ErrorKind::invalidArgument, "unit: expected a positive length, found {} m", settings.metresPerUnit);
  return {};
}

Result<BuildResult> buildPack(std::span<const std::filesystem::path> meshes, const std::filesystem::path& pack,
                              const BuildOptions& options, Progress& progress) {
  const auto start = std::chrono::steady_clock::now();
  FARCELL_TRY(checkSettings(options.settings));
  const int threads = threadCount(options.threads);
  const std::filesystem::path beside = pack.has_parent_path() ? pack.parent_path() : std::filesystem::path(".");
  FARCELL_ASSIGN(PackWriter writer, PackWriter::create(pack));
  FARCELL_ASSIGN(const std::unique_ptr<MeshReader> reader, openMeshes(meshes));
  BuildSettings settings = options.settings;
  if (options.upOfModel) settings.up = reader->info().up;
  if (options.unitOfModel) settings.metresPerUnit = reader->info().metresPerUnit;

  const std::filesystem::path& scratch = options.scratchDirectory.empty() ? beside : options.scratchDirectory;

  BuildResult result;
  Directory& directory = result.directory;
  directory.sourceName = meshes[0].filename().string();
  FARCELL_ASSIGN(directory.sourceHash, sourceHash(*reader));
  FARCELL_ASSIGN(const Textures textures, Textures::open(reader->textures(), scratch, threads, progress));
  result.textures = {textures.count() - textures.leftOut().size(), textures.leftOut()};
  FARCELL_ASSIGN(const WorkDirectory work, WorkDirectory::create(scratch));
  const PartitionOptions partitionOptions{work.path(), threads, kPartitionMemoryBytes};
  FARCELL_ASSIGN(const Partition partition, partitionMesh(*reader, settings, partitionOptions, progress));
  CellTree tree = cellTreeOf(partition.leaves, partition.triangles);
  directory.model = {partition.grid, partition.bounds, settings, reader->info().hasNormals, reader->info().hasColours};
  directory.report.inputTriangles = partition.counts.accepted;
  directory.report.inputVertices = reader->info().vertices;
  directory.report.skipped = partition.counts.skipped;
  directory.cells = tree.cells;
  result.seconds.partition = partition.splitSeconds;
  result.seconds.read = secondsSince(start) - partition.splitSeconds;
  FARCELL_TRY(bakeCells(tree, partition, textures, threads, writer, directory, result.seconds, progress));
  progress.end();
  FARCELL_ASSIGN(result.packBytes, writer.finish(directory));
  result.seconds.total = secondsSince(start);
  return result;
}

}  // namespace farcell
