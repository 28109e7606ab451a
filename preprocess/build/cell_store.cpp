#include "preprocess/build/cell_store.h"

#include <algorithm>
#include <iterator>

#include "cache/base/check.h"
#include "cache/pack/bytes.h"

namespace farcell {
namespace {

uint64_t idOf(const ViewBatch& batch) { return uint64_t{batch.cell} << 32 | batch.firstPair; }

uint32_t storedBytes(const CodedMesh& mesh) {
  uint64_t sum = 0;
  for (const CodedPart& part : mesh.parts) sum += part.bytes.size();
  return static_cast<uint32_t>(std::min<uint64_t>(sum, UINT32_MAX));
}

}  // namespace

Result<std::unique_ptr<CellStore>> CellStore::open(const std::filesystem::path& workDirectory, uint32_t writer,
                                                   const ViewLimits& limits) {
  std::unique_ptr<CellStore> store(new CellStore(limits));
  CellStore* const raw = store.get();
  FARCELL_ASSIGN(Journal journal, Journal::open(workDirectory, writer,
                                                [raw](const JournalRecord& record, std::span<const std::byte> head,
                                                      const JournalPlace& place) { raw->found(record, head, place); }));
  store->journal_ = std::make_unique<Journal>(std::move(journal));
  return store;
}

Result<> CellStore::add(uint32_t cell, const CodedMesh& mesh) {
  ByteWriter head, body;
  head.u64(mesh.triangles);
  head.f64(mesh.errorSteps);
  head.u32(storedBytes(mesh));
  body.u32(static_cast<uint32_t>(mesh.parts.size()));
  for (const CodedPart& part : mesh.parts) {
    body.u32(part.decodedBytes);
    body.u32(static_cast<uint32_t>(part.bytes.size()));
    body.append(part.bytes);
  }
  return journal_->add({static_cast<uint32_t>(Kind::mesh), cell}, head.bytes, body.bytes);
}

Result<> CellStore::add(const ViewBatch& batch, std::span<const ViewCost> baked, std::span<const EncodedView> views) {
  ByteWriter head;
  for (const ViewCost& view : baked) {
    head.u32(view.view);
    head.u32(view.bytes);
    head.u32(view.texels);
  }
  return journal_->add({static_cast<uint32_t>(Kind::views), idOf(batch)}, head.bytes, viewPageOf(views).bytes);
}

// A head of the wrong size is not ours and says nothing: its checksum was right, so no crash made it.
void CellStore::found(const JournalRecord& record, std::span<const std::byte> head, const JournalPlace& place) {
  const std::lock_guard lock(mutex_);
  ByteReader in(head);
  if (record.kind == static_cast<uint32_t>(Kind::mesh)) {
    StoredMesh mesh{{}, place};
    mesh.figures.triangles = in.u64();
    mesh.figures.errorSteps = in.f64();
    mesh.figures.bytes = in.u32();
    meshes_.emplace(static_cast<uint32_t>(record.id), mesh);
  } else if (record.kind == static_cast<uint32_t>(Kind::views) && batches_.emplace(record.id, place).second) {
    foundViews(static_cast<uint32_t>(record.id >> 32), head);
  }
}

void CellStore::foundViews(uint32_t cell, std::span<const std::byte> head) {
  ByteReader in(head);
  while (in.remaining() > 0 && in.ok()) {
    ViewCost cost{cell};
    cost.view = in.u32();
    cost.bytes = in.u32();
    cost.texels = in.u32();
    views_.push_back(cost);
  }
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
  return meshes_.at(cell).figures;
}

Result<CodedMesh> CellStore::mesh(uint32_t cell) const {
  StoredMesh stored;
  {
    const std::lock_guard lock(mutex_);
    stored = meshes_.at(cell);
  }
  FARCELL_ASSIGN(const std::vector<std::byte> body, journal_->read(stored.place));
  CodedMesh mesh{stored.figures.triangles, stored.figures.errorSteps, {}};
  ByteReader in(body);
  for (uint32_t parts = in.u32(); parts > 0 && in.ok(); --parts) {
    CodedPart& part = mesh.parts.emplace_back();
    part.decodedBytes = in.u32();
    const std::span<const std::byte> bytes = in.take(in.u32());
    part.bytes.assign(bytes.begin(), bytes.end());
  }
  FARCELL_CHECK(in.ok());
  return mesh;
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
    FARCELL_ASSIGN(std::vector<EncodedView> batch, viewsOfPage(body, limits_));
    std::move(batch.begin(), batch.end(), std::back_inserter(views));
  }
  std::sort(views.begin(), views.end(), [](const EncodedView& a, const EncodedView& b) { return a.view < b.view; });
  return views;
}

std::vector<ViewCost> CellStore::viewCosts() const {
  const std::lock_guard lock(mutex_);
  std::vector<ViewCost> views = views_;
  std::sort(views.begin(), views.end(),
            [](const ViewCost& a, const ViewCost& b) { return a.cell != b.cell ? a.cell < b.cell : a.view < b.view; });
  return views;
}

}  // namespace farcell
