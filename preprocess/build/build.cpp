#include "preprocess/build/build.h"

#include <malloc.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <optional>
#include <vector>

#include "cache/base/hash.h"
#include "cache/base/interrupt.h"
#include "cache/base/parallel.h"
#include "cache/pack/directory_codec.h"
#include "cache/pack/pack_file.h"
#include "preprocess/build/assemble.h"
#include "preprocess/build/bake_job.h"
#include "preprocess/build/measure_job.h"
#include "preprocess/build/mesh_job.h"
#include "preprocess/build/source_record.h"
#include "preprocess/build/work_directory.h"
#include "preprocess/choose/forms_by_height.h"
#include "preprocess/partition/partition.h"
#include "preprocess/read/open_mesh.h"
#include "preprocess/texture/textures.h"

namespace farcell {
namespace {

using Samplers = std::vector<std::unique_ptr<TextureSampler>>;

double secondsSince(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

// Pages that the system gives are zeroed, one fault each: a fifth of all the time of a build. What a job frees is kept
// for the next, as far as the ceiling has room for that on every thread.
void keepFreedMemory(uint64_t memoryBytes, int threads) {
  constexpr uint64_t kLeast = uint64_t{4} << 20, kMost = uint64_t{64} << 20;
  const uint64_t kept = std::clamp(memoryBytes / 8 / static_cast<uint64_t>(threads), kLeast, kMost);
  ::mallopt(M_TRIM_THRESHOLD, static_cast<int>(kept));
  ::mallopt(M_MMAP_THRESHOLD, static_cast<int>(kept / 2));
}

// One for each thread; nulls when the mesh has no textures.
Samplers samplersOf(const Textures& textures, int threads) {
  Samplers samplers(static_cast<size_t>(threads));
  for (auto& sampler : samplers)
    if (textures.count() > 0) sampler = textures.sampler();
  return samplers;
}

// Runs jobs on all threads, until the first error.
Result<> runJobs(size_t count, int threads, const std::function<Result<>(size_t job, int thread)>& run) {
  std::atomic<bool> failed{false};
  std::mutex mutex;
  std::optional<Error> error;
  parallelFor(count, threads, [&](size_t job, int thread) {
    if (failed) return;
    const Result<> done = checkInterrupt().and_then([&] { return run(job, thread); });
    if (done || failed.exchange(true)) return;
    const std::lock_guard lock(mutex);
    error = done.error();
  });
  if (error) return tl::unexpected<Error>(*error);
  return {};
}

class Jobs {
 public:
  Jobs(const BuildContext& context, const Samplers& samplers, int threads, Crew& crew, Progress& progress)
      : context_(context), samplers_(samplers), threads_(threads), crew_(crew), progress_(progress) {}

  Result<> meshes() {
    const std::vector<uint32_t> leaves = ownCells(leavesOf(context_.tree));
    std::vector<std::vector<uint32_t>> levels = innerCellsFromTheBottom(context_.tree);
    uint64_t count = leaves.size();
    for (std::vector<uint32_t>& level : levels) count += (level = ownCells(level)).size();
    progress_.begin("mesh", count, "cells");
    FARCELL_TRY(run(leaves.size(), [&](size_t job, int thread) -> Result<> {
      progress_.advance();
      return codeLeaf(context_, leaves[job], samplers_[static_cast<size_t>(thread)].get());
    }));
    for (const std::vector<uint32_t>& level : levels) {
      FARCELL_TRY(run(level.size(), [&](size_t job, int) -> Result<> {
        progress_.advance();
        return simplifyInner(context_, level[job]);
      }));
    }
    return {};
  }

  Result<> views() {
    const std::vector<ViewBatch> batches =
        own(viewBatches(context_), [&](const ViewBatch& batch) { return context_.store.has(batch); });
    uint64_t pairs = 0;
    for (const ViewBatch& batch : batches) pairs += batch.pairCount;
    progress_.begin("bake", 2 * pairs, "views");
    return run(batches.size(), [&](size_t job, int thread) -> Result<> {
      FARCELL_TRY(bakeBatch(context_, batches[job], samplers_[static_cast<size_t>(thread)].get()));
      progress_.advance(2 * uint64_t{batches[job].pairCount});
      return {};
    });
  }

  // Before views.
  Result<> forms() {
    const std::vector<uint32_t> jobs =
        own(cellsOfCandidates(context_.tree), [&](uint32_t cell) { return context_.store.hasCandidates(cell); });
    progress_.begin("measure", jobs.size(), "cells");
    return run(jobs.size(), [&](size_t job, int thread) -> Result<> {
      progress_.advance();
      return measureForms(context_, jobs[job], samplers_[static_cast<size_t>(thread)].get());
    });
  }

  // After meshes and views.
  Result<> errors() {
    const Measure measure = context_.model.settings.measure;
    if (measure == Measure::off) return {};
    const std::vector<uint32_t> jobs =
        own(cellsToMeasure(context_.tree, measure), [&](uint32_t cell) { return context_.store.hasErrors(cell); });
    progress_.begin("measure", jobs.size(), "cells");
    return run(jobs.size(), [&](size_t job, int thread) -> Result<> {
      progress_.advance();
      return measureStored(context_, jobs[job], samplers_[static_cast<size_t>(thread)].get());
    });
  }

 private:
  // The jobs that fall to this process and are not done. Which fall to whom depends on nothing else: processes do not
  // learn at the same moment of what is done.
  template <class Job, class Done>
  std::vector<Job> own(const std::vector<Job>& all, const Done& done) const {
    std::vector<Job> jobs;
    for (size_t i = crew_.rank(); i < all.size(); i += crew_.size())
      if (!done(all[i])) jobs.push_back(all[i]);
    return jobs;
  }
  std::vector<uint32_t> ownCells(const std::vector<uint32_t>& all) const {
    return own(all, [&](uint32_t cell) { return context_.store.hasMesh(cell); });
  }
  // Ends when all processes have done theirs, and knows what they have done.
  Result<> run(size_t count, const std::function<Result<>(size_t job, int thread)>& job) {
    FARCELL_TRY(crew_.together(runJobs(count, threads_, job).and_then([&] { return context_.store.sync(); })));
    return context_.store.refresh();
  }

  const BuildContext& context_;
  const Samplers& samplers_;
  const int threads_;
  Crew& crew_;
  Progress& progress_;
};

// Everything that decides what jobs make; the identity of the work directory.
std::string identityOf(const SourceRecord& source, const BuildSettings& settings) {
  BuildSettings ofJobs = settings;
  ofJobs.packBudgetBytes = 0;  // the pack is put together anew each time
  ofJobs.budgetRule = BudgetRule::worth;
  return fmt::format("farcell {} pack {} settings {:016x}\n", FARCELL_VERSION, kPackVersion, hashSettings(ofJobs)) +
         source.identity;
}

class Build {
 public:
  Build(std::span<const std::filesystem::path> meshes, const std::filesystem::path& pack, const BuildOptions& options,
        Progress& progress)
      : meshes_(meshes),
        pack_(pack),
        options_(options),
        threads_(threadCount(options.threads)),
        crew_(options.crew != nullptr ? *options.crew : alone_),
        progress_(progress) {}

  Result<BuildResult> run() {
    const Result<> built = phases();
    if (workDirectory_) FARCELL_TRY(leave(built));
    if (!built) return tl::unexpected<Error>(built.error());
    result_.seconds.total = secondsSince(start_);
    return std::move(result_);
  }

 private:
  bool leads() const { return crew_.rank() == 0; }

  Result<> phases() {
    workPath_ = WorkDirectory::placeOf(options_.workParent, pack_);
    FARCELL_TRY(crew_.together(leads() ? open().and_then([this] { return partition(); }) : Result<>()));
    if (!leads()) FARCELL_TRY(follow());
    describe(result_.directory);
    return work();
  }

  // What was done stays where going on makes sense: not after success, nor when the input or a setting is wrong.
  Result<> leave(const Result<>& built) {
    store_.reset();
    partition_.reset();
    textures_.reset();
    const bool goesOn = !built && (built.error().kind == ErrorKind::cancelled || built.error().kind == ErrorKind::io ||
                                   built.error().kind == ErrorKind::exhausted);
    // An input that is not there today may be there tomorrow: what was done before is not this attempt's to remove.
    if ((goesOn || !identified_) && workDirectory_->holdsWork()) return {};
    return workDirectory_->remove();
  }

  Result<> open() {
    FARCELL_TRY(checkSettings(options_.settings));
    if (options_.memoryBytes < kMinMemoryBytes)
      return fail(ErrorKind::invalidArgument, "memory: expected at least {} MiB, found {}", kMinMemoryBytes >> 20,
                  options_.memoryBytes >> 20);
    // Known before hours of work, not after them. Also clears away what a killed build left of the pack.
    FARCELL_TRY(OutputFile::create(pack_));
    FARCELL_ASSIGN(WorkDirectory directory, WorkDirectory::open(options_.workParent, pack_));
    workDirectory_.emplace(std::move(directory));
    std::optional<SourceRecord> recorded = SourceRecord::load(workPath_, meshes_);
    if (recorded)
      source_ = *std::move(recorded);
    else
      FARCELL_TRY(openSource());
    FARCELL_TRY(takeSource());
    FARCELL_ASSIGN(result_.resumed, workDirectory_->belongsTo(identityOf(source_, settings_)));
    identified_ = true;
    return result_.resumed ? Result<>() : preflight();
  }

  Result<> openSource() {
    FARCELL_ASSIGN(reader_, openMeshes(meshes_, {options_.memoryBytes / 4, workPath_}));
    FARCELL_ASSIGN(source_, SourceRecord::of(*reader_));
    return {};
  }

  // What of the result and the settings comes from the source.
  Result<> takeSource() {
    result_.files = source_.files;
    result_.directory.sourceHash = source_.hash;
    settings_ = options_.settings;
    if (options_.upOfModel) settings_.up = source_.info.up;
    if (options_.unitOfModel) settings_.metresPerUnit = source_.info.metresPerUnit;
    return readVisitable();
  }

  // Whether the disk can hold what is to come, as far as the input tells.
  Result<> preflight() {
    constexpr uint64_t kJobsBytesOfTriangle = 50;  // coded views and meshes of a triangle: twice the usual
    const MeshInfo& info = source_.info;
    const uint64_t needed =
        scratchBytesEstimate(info, source_.textures > 0) + kJobsBytesOfTriangle * info.declaredTriangles;
    FARCELL_ASSIGN(const uint64_t free, freeBytes(workPath_));
    if (options_.tell)
      options_.tell(fmt::format("{}: about {:.2f} GB for work, {:.2f} GB free", workPath_.string(),
                                1e-9 * static_cast<double>(needed), 1e-9 * static_cast<double>(free)));
    progress_.budget("disk", needed, [path = workPath_] { return directoryBytes(path); });
    if (free >= needed) return {};
    return fail(ErrorKind::exhausted,
                "{}: expected {} bytes free for work, found {}; --work-dir may name another place", workPath_.string(),
                needed, free);
  }

  Result<> readVisitable() {
    FARCELL_ASSIGN(region_, readRegion(options_.visitable, settings_.metresPerUnit));
    if (region_.kind == Region::Kind::everywhere) return {};
    std::string text = options_.visitable;
    if (region_.kind == Region::Kind::boxes) {
      FARCELL_ASSIGN(text, readTextFile(options_.visitable, kMaxRegionFileBytes));
    }
    settings_.visitableHash = hashBytes(std::as_bytes(std::span(text)));
    return {};
  }

  Result<> partition() {
    const auto start = std::chrono::steady_clock::now();
    if (result_.resumed && !reader_) {
      FARCELL_ASSIGN(const bool there, recall());
      if (there) return {};
    }
    if (!reader_) FARCELL_TRY(openSource());
    FARCELL_ASSIGN(textures_, Textures::open(reader_->textures(), workPath_, threads_, progress_));
    const PartitionOptions options{partitionPath(), threads_, options_.memoryBytes / 2};
    FARCELL_TRY(makeDirectory(options.workDirectory));
    FARCELL_ASSIGN(partition_, partitionMesh(*reader_, settings_, options, progress_));
    FARCELL_TRY(source_.save(workPath_, meshes_));
    result_.seconds.partition = partition_->splitSeconds;
    result_.seconds.read = secondsSince(start) - partition_->splitSeconds;
    reader_.reset();
    ::malloc_trim(0);  // vertices and chunks: jobs have the memory now
    return {};
  }

  // Textures and partition as an earlier run, or the leader, left them; false where they are not whole.
  Result<bool> recall() {
    textures_ = Textures::load(workPath_, source_.textures);
    FARCELL_ASSIGN(partition_, loadPartition(partitionPath()));
    return textures_ && partition_;
  }

  // After the leader's partition, without a look at the meshes.
  Result<> follow() {
    std::optional<SourceRecord> recorded = SourceRecord::load(workPath_, meshes_);
    if (!recorded)
      return fail(ErrorKind::io, "{}: expected what the first process read of the input, found nothing of these meshes",
                  workPath_.string());
    source_ = *std::move(recorded);
    FARCELL_TRY(takeSource());
    FARCELL_ASSIGN(const bool there, recall());
    if (there) return {};
    return fail(ErrorKind::io, "{}: expected the partition that the first process made, found none whole",
                workPath_.string());
  }

  std::filesystem::path partitionPath() const { return workPath_ / "partition"; }

  static Result<> makeDirectory(const std::filesystem::path& path) {
    std::error_code code;
    std::filesystem::create_directory(path, code);
    if (code) return fail(ErrorKind::io, "{}: cannot make the directory: {}", path.string(), code.message());
    return {};
  }

  void describe(Directory& directory) {
    tree_ = cellTreeOf(partition_->leaves, partition_->triangles);
    for (CellRecord& cell : tree_.cells) cell.form = settings_.form;
    if (settings_.forms == Forms::byHeight) setFormsByHeight(settings_.form, tree_.cells);
    result_.textures = {textures_->count() - textures_->leftOut().size(), textures_->leftOut()};
    directory.sourceName = meshes_[0].filename().string();
    directory.model = {
        partition_->grid,        partition_->bounds,      settings_,
        source_.info.hasNormals, source_.info.hasColours, source_.info.hasColours && textures_->haveSides()};
    directory.report.inputTriangles = partition_->counts.accepted;
    directory.report.inputVertices = source_.info.vertices;
    directory.report.skipped = partition_->counts.skipped;
    directory.cells = tree_.cells;
  }

  Result<> work() {
    const Directory& directory = result_.directory;
    FARCELL_ASSIGN(store_, CellStore::open(workPath_, crew_.rank()));
    const auto start = std::chrono::steady_clock::now();
    MemoryGate gate(jobMemory());
    WorkClock clock;
    std::vector<ViewMask> seen;
    const BuildContext context{directory.model,
                               tree_,
                               *partition_,
                               seen,
                               textures_->count() > 0,
                               *store_,
                               gate,
                               jobMemory() / static_cast<uint64_t>(threads_),
                               clock};
    const Samplers samplers = samplersOf(*textures_, threads_);
    Jobs jobs(context, samplers, threads_, crew_, progress_);
    FARCELL_TRY(jobs.meshes());
    if (settings_.forms == Forms::chosen) {
      FARCELL_TRY(jobs.forms());
      chooseForms();
    }
    seen = seenViews();
    FARCELL_TRY(jobs.views());
    FARCELL_TRY(jobs.errors());
    shareTime(clock, secondsSince(start));
    if (leads()) FARCELL_TRY(assemble(context));
    return {};
  }

  // The same in all processes.
  void chooseForms() {
    std::vector<bool> baked;
    for (const CellRecord& cell : tree_.cells) baked.push_back(isBaked(cell));
    result_.measured.forms = farcell::chooseForms(result_.directory.model, tree_.cells, baked, store_->candidates());
    for (const KindForms& kind : result_.measured.forms.kinds)
      for (size_t cell = 0; cell < tree_.cells.size(); ++cell)
        if (kindOf(tree_.cells[cell]) == kind.kind)
          tree_.cells[cell].form = result_.directory.cells[cell].form = candidateForm(kind.chosen);
  }

  // Empty when visitors may be anywhere.
  std::vector<ViewMask> seenViews() const {
    if (region_.kind == Region::Kind::everywhere) return {};
    std::map<int, Visitable> sets;
    for (const CellRecord& cell : tree_.cells)
      sets.try_emplace(cell.form.views, region_, result_.directory.model, tree_.cells, Viewpoints::of(cell.form.views));
    std::vector<ViewMask> seen(tree_.cells.size());
    parallelFor(seen.size(), threads_,
                [&](size_t cell, int) { seen[cell] = sets.at(tree_.cells[cell].form.views).seen(tree_.cells[cell]); });
    return seen;
  }

  // What is left of the ceiling beside the program itself and the tables of cells, pages and views.
  uint64_t jobMemory() const {
    constexpr uint64_t kProgram = uint64_t{48} << 20;
    constexpr uint64_t kTablesOfView = 2 * sizeof(ViewCost);
    const uint64_t cells = tree_.cells.size();
    uint64_t views = 0;
    for (const CellRecord& cell : tree_.cells) views += static_cast<uint64_t>(cell.form.views);
    const uint64_t tables = cells * (6 * sizeof(CellRecord) + 8 * sizeof(PageRecord)) + views * kTablesOfView;
    return options_.memoryBytes > kProgram + tables ? options_.memoryBytes - kProgram - tables : 0;
  }

  void shareTime(const WorkClock& clock, double wall) {
    result_.cpuSeconds.lod = 1e-9 * static_cast<double>(clock.meshNs);
    result_.cpuSeconds.bake = 1e-9 * static_cast<double>(clock.bakeNs);
    result_.cpuSeconds.encode = 1e-9 * static_cast<double>(clock.encodeNs);
    result_.cpuSeconds.measure = 1e-9 * static_cast<double>(clock.measureNs);
    const double work =
        std::max(static_cast<double>(clock.meshNs + clock.bakeNs + clock.encodeNs + clock.measureNs), 1.0);
    result_.seconds.lod = wall * static_cast<double>(clock.meshNs) / work;
    result_.seconds.bake = wall * static_cast<double>(clock.bakeNs) / work;
    result_.seconds.encode = wall * static_cast<double>(clock.encodeNs) / work;
    result_.seconds.measure = wall * static_cast<double>(clock.measureNs) / work;
  }

  Result<> assemble(const BuildContext& context) {
    Directory& directory = result_.directory;
    std::vector<uint32_t> geometryBytes(tree_.cells.size());
    for (uint32_t cell = 0; cell < tree_.cells.size(); ++cell) {
      const MeshFigures mesh = store_->meshFigures(cell);
      directory.cells[cell].meshTriangles = mesh.triangles;
      directory.cells[cell].geometricError = mesh.errorSteps * directory.model.grid.step();
      geometryBytes[cell] = mesh.bytes;
    }
    const std::vector<ViewCost> views = store_->viewCosts();
    expect(views, directory);
    ChooseSettings settings;
    settings.rule = settings_.budgetRule;
    if (settings_.packBudgetBytes > 0) settings.packBudgetBytes = settings_.packBudgetBytes;
    FARCELL_ASSIGN(const Choice choice, chooseViews({directory.cells, geometryBytes, views}, settings));
    report(choice, views.size(), directory.report);
    FARCELL_ASSIGN(result_.packBytes, assemblePack(context, pack_, views, choice.views, directory, progress_));
    progress_.end();
    return {};
  }

  void expect(std::span<const ViewCost> views, Directory& directory) {
    const std::map<uint32_t, CellErrors> measured = store_->errors();
    const ExpectedErrors expected =
        expectErrors(directory.model, directory.cells, viewFigures(directory.cells.size(), views), measured);
    for (size_t cell = 0; cell < directory.cells.size(); ++cell) directory.cells[cell].errors = expected.tables[cell];
    result_.measured.cells = measured.size();
    result_.measured.unit = expected.unit;
    result_.measured.apart = expected.apart;
  }

  void report(const Choice& choice, uint64_t viewsBaked, BuildReport& report) const {
    report.viewsBaked = viewsBaked;
    const auto leftOut = [&](const char* reason, const LeftOutCount& count) {
      if (count.views == 0) return;
      report.viewsLeftOut[reason] += count.views;
      report.bytesLeftOut[reason] += count.bytes;
    };
    LeftOutCount triangles;  // never baked
    for (const CellRecord& cell : tree_.cells)
      if (cheaperAsTriangles(cell)) triangles.views += static_cast<uint64_t>(cell.form.views);
    leftOut(nameOf(ViewFate::cheaperAsTriangles), triangles);
    for (size_t fate = 0; fate < kViewFates; ++fate) {
      LeftOutCount count = choice.counts[fate];
      if (static_cast<ViewFate>(fate) == ViewFate::notVisitable) count.views -= triangles.views;
      if (static_cast<ViewFate>(fate) != ViewFate::kept) leftOut(nameOf(static_cast<ViewFate>(fate)), count);
    }
  }

  const std::span<const std::filesystem::path> meshes_;
  const std::filesystem::path& pack_;
  const BuildOptions& options_;
  const int threads_;
  Alone alone_;
  Crew& crew_;
  Progress& progress_;
  const std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();

  SourceRecord source_;
  BuildSettings settings_;
  std::filesystem::path workPath_;
  std::optional<WorkDirectory> workDirectory_;  // the leader's
  bool identified_ = false;                     // what is there belongs to this build
  std::unique_ptr<MeshReader> reader_;          // until the partition is done
  std::optional<Textures> textures_;
  std::optional<Partition> partition_;
  CellTree tree_;
  Region region_;
  std::unique_ptr<CellStore> store_;
  BuildResult result_;
};

}  // namespace

Result<BuildResult> buildPack(std::span<const std::filesystem::path> meshes, const std::filesystem::path& pack,
                              const BuildOptions& options, Progress& progress) {
  keepFreedMemory(options.memoryBytes, threadCount(options.threads));
  return Build(meshes, pack, options, progress).run();
}

}  // namespace farcell
