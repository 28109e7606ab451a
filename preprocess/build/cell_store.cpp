#include "preprocess/build/cell_store.h"

#include <algorithm>
#include <iterator>

#include "cache/base/check.h"
#include "cache/pack/bytes.h"

namespace farcell {
namespace {

uint64_t idOf(uint32_t cell, uint32_t what) { return uint64_t{cell} << 32 | what; }
uint64_t idOf(const ViewBatch& batch) { return idOf(batch.cell, batch.firstPair); }

// What checksums cover is ours: of any form.
constexpr ViewLimits kStoredViews = {1280, kMaxImageSize, UINT64_MAX};

// In the order of the journal.
template <size_t size, class Visit>
void forEachNumber(std::array<ErrorSum, size>& sums, const Visit& visit) {
  for (ErrorSum& sum : sums) {
    visit(sum.error);
    visit(sum.covered);
  }
}
template <class Visit>
void forEachNumber(CellErrors& errors, const Visit& visit) {
  forEachNumber(errors.single, visit);
  for (auto& way : errors.ways) forEachNumber(way, visit);
}
template <class Visit>
void forEachNumber(CellCandidates& candidates, const Visit& visit) {
  forEachNumber(candidates.single, visit);
  forEachNumber(candidates.triangles, visit);
  for (CandidateErrors& form : candidates.forms) {
    forEachNumber(form.depthCorrected, visit);
    forEachNumber(form.blended, visit);
    visit(form.bytes);
  }
}

}  // namespace

Result<std::unique_ptr<CellStore>> CellStore::open(const std::filesystem::path& workDirectory, uint32_t writer) {
  std::unique_ptr<CellStore> store(new CellStore);
  CellStore* const raw = store.get();
  FARCELL_ASSIGN(Journal journal, Journal::open(workDirectory, writer,
                                                [raw](const JournalRecord& record, std::span<const std::byte> head,
                                                      const JournalPlace& place) { raw->found(record, head, place); }));
  store->journal_ = std::make_unique<Journal>(std::move(journal));
  return store;
}

Result<> CellStore::addPart(Kind kind, uint32_t cell, uint32_t part, const CodedPart& coded) {
  ByteWriter head;
  head.u32(coded.decodedBytes);
  return journal_->add({static_cast<uint32_t>(kind), idOf(cell, part)}, head.bytes, coded.bytes);
}

Result<> CellStore::add(uint32_t cell, uint32_t part, const CodedPart& coded) {
  return addPart(Kind::part, cell, part, coded);
}

Result<> CellStore::addColoured(uint32_t cell, uint32_t part, const CodedPart& coded) {
  return addPart(Kind::coloured, cell, part, coded);
}

Result<> CellStore::addTexture(uint32_t cell, uint32_t group, const CodedPart& coded) {
  return addPart(Kind::texture, cell, group, coded);
}

Result<> CellStore::add(uint32_t cell, const MeshFigures& mesh) {
  ByteWriter head;
  head.u64(mesh.triangles);
  head.f64(mesh.errorSteps);
  head.u32(mesh.parts);
  head.u32(mesh.bytes);
  return journal_->add({static_cast<uint32_t>(Kind::mesh), cell}, head.bytes, {});
}

Result<> CellStore::add(const ViewBatch& batch, std::span<const ViewCost> baked, std::span<const EncodedView> views) {
  ByteWriter head;
  for (const ViewCost& view : baked) {
    head.u32(view.view);
    head.u32(view.bytes);
    head.u32(view.texels);
    head.u32(view.covered);
    head.u32(view.edges);
  }
  return journal_->add({static_cast<uint32_t>(Kind::views), idOf(batch)}, head.bytes, viewPageOf(views).bytes);
}

Result<> CellStore::addErrors(uint32_t cell, CellErrors errors) {
  ByteWriter head;
  forEachNumber(errors, [&](double number) { head.f64(number); });
  return journal_->add({static_cast<uint32_t>(Kind::errors), cell}, head.bytes, {});
}

Result<> CellStore::addCandidates(uint32_t cell, CellCandidates candidates) {
  ByteWriter head;
  forEachNumber(candidates, [&](double number) { head.f64(number); });
  return journal_->add({static_cast<uint32_t>(Kind::candidates), cell}, head.bytes, {});
}

// A head of the wrong size is not ours and says nothing: its checksum was right, so no crash made it.
void CellStore::found(const JournalRecord& record, std::span<const std::byte> head, const JournalPlace& place) {
  const std::lock_guard lock(mutex_);
  ByteReader in(head);
  if (record.kind == static_cast<uint32_t>(Kind::part)) {
    parts_.emplace(record.id, StoredPart{in.u32(), place});
  } else if (record.kind == static_cast<uint32_t>(Kind::coloured)) {
    coloured_.emplace(record.id, StoredPart{in.u32(), place});
  } else if (record.kind == static_cast<uint32_t>(Kind::texture)) {
    textures_.emplace(record.id, StoredPart{in.u32(), place});
  } else if (record.kind == static_cast<uint32_t>(Kind::mesh)) {
    MeshFigures mesh;
    mesh.triangles = in.u64();
    mesh.errorSteps = in.f64();
    mesh.parts = in.u32();
    mesh.bytes = in.u32();
    meshes_.emplace(static_cast<uint32_t>(record.id), mesh);
  } else if (record.kind == static_cast<uint32_t>(Kind::views) && batches_.emplace(record.id, place).second) {
    foundViews(static_cast<uint32_t>(record.id >> 32), head);
  } else if (record.kind == static_cast<uint32_t>(Kind::errors)) {
    foundErrors(static_cast<uint32_t>(record.id), head);
  } else if (record.kind == static_cast<uint32_t>(Kind::candidates)) {
    foundCandidates(static_cast<uint32_t>(record.id), head);
  }
}

void CellStore::foundViews(uint32_t cell, std::span<const std::byte> head) {
  ByteReader in(head);
  while (in.remaining() > 0 && in.ok()) {
    ViewCost cost{cell};
    cost.view = in.u32();
    cost.bytes = in.u32();
    cost.texels = in.u32();
    cost.covered = in.u32();
    cost.edges = in.u32();
    views_.push_back(cost);
  }
}

void CellStore::foundErrors(uint32_t cell, std::span<const std::byte> head) {
  CellErrors errors;
  ByteReader in(head);
  forEachNumber(errors, [&](double& number) { number = in.f64(); });
  errors_.emplace(cell, errors);
}

void CellStore::foundCandidates(uint32_t cell, std::span<const std::byte> head) {
  CellCandidates candidates;
  ByteReader in(head);
  forEachNumber(candidates, [&](double& number) { number = in.f64(); });
  candidates_.emplace(cell, candidates);
}

bool CellStore::hasMesh(uint32_t cell) const {
  const std::lock_guard lock(mutex_);
  return meshes_.count(cell) > 0;
}

bool CellStore::has(const ViewBatch& batch) const {
  const std::lock_guard lock(mutex_);
  return batches_.count(idOf(batch)) > 0;
}

MeshFigures CellStore::meshFigures(uint32_t cell) const {
  const std::lock_guard lock(mutex_);
  return meshes_.at(cell);
}

Result<CodedPart> CellStore::part(uint32_t cell, uint32_t part) const {
  StoredPart stored;
  {
    const std::lock_guard lock(mutex_);
    stored = parts_.at(idOf(cell, part));
  }
  return read(stored);
}

Result<CodedPart> CellStore::read(const StoredPart& stored) const {
  FARCELL_ASSIGN(std::vector<std::byte> bytes, journal_->read(stored.place));
  return CodedPart{stored.decodedBytes, std::move(bytes)};
}

Result<CodedPart> CellStore::coloured(uint32_t cell, uint32_t part) const {
  StoredPart stored;
  {
    const std::lock_guard lock(mutex_);
    const auto found = coloured_.find(idOf(cell, part));
    stored = found != coloured_.end() ? found->second : parts_.at(idOf(cell, part));
  }
  return read(stored);
}

std::vector<uint32_t> CellStore::textureGroups(uint32_t cell) const {
  const std::lock_guard lock(mutex_);
  std::vector<uint32_t> groups;
  const auto end = textures_.lower_bound(idOf(cell + 1, 0));
  for (auto page = textures_.lower_bound(idOf(cell, 0)); page != end; ++page)
    groups.push_back(static_cast<uint32_t>(page->first));
  return groups;
}

Result<CodedPart> CellStore::texture(uint32_t cell, uint32_t group) const {
  StoredPart stored;
  {
    const std::lock_guard lock(mutex_);
    stored = textures_.at(idOf(cell, group));
  }
  return read(stored);
}

Result<std::vector<EncodedView>> CellStore::views(uint32_t cell) const {
  std::vector<JournalPlace> places;
  {
    const std::lock_guard lock(mutex_);
    const auto end = batches_.lower_bound(idOf({cell + 1}));
    for (auto batch = batches_.lower_bound(idOf({cell})); batch != end; ++batch) places.push_back(batch->second);
  }
  std::vector<EncodedView> views;
  for (const JournalPlace& place : places) {
    FARCELL_ASSIGN(const std::vector<std::byte> body, journal_->read(place));
    FARCELL_ASSIGN(std::vector<EncodedView> batch, viewsOfPage(body, kStoredViews));
    std::move(batch.begin(), batch.end(), std::back_inserter(views));
  }
  std::sort(views.begin(), views.end(), [](const EncodedView& a, const EncodedView& b) { return a.view < b.view; });
  return views;
}

bool CellStore::hasErrors(uint32_t cell) const {
  const std::lock_guard lock(mutex_);
  return errors_.count(cell) > 0;
}

bool CellStore::hasCandidates(uint32_t cell) const {
  const std::lock_guard lock(mutex_);
  return candidates_.count(cell) > 0;
}

std::map<uint32_t, CellCandidates> CellStore::candidates() const {
  const std::lock_guard lock(mutex_);
  return candidates_;
}

std::map<uint32_t, CellErrors> CellStore::errors() const {
  const std::lock_guard lock(mutex_);
  return errors_;
}

std::vector<ViewCost> CellStore::viewCosts() const {
  const std::lock_guard lock(mutex_);
  std::vector<ViewCost> views = views_;
  std::sort(views.begin(), views.end(),
            [](const ViewCost& a, const ViewCost& b) { return a.cell != b.cell ? a.cell < b.cell : a.view < b.view; });
  return views;
}

}  // namespace farcell
