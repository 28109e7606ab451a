// What the jobs of a build have finished: meshes and views of cells, coded, in the journal of the work directory.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <mutex>
#include <vector>

#include "cache/pack/encoded_view.h"
#include "preprocess/build/journal.h"
#include "preprocess/choose/choose.h"
#include "preprocess/measure/candidates.h"

namespace farcell {

// One part of a mesh, as the pack keeps it.
struct CodedPart {
  uint32_t decodedBytes = 0;
  std::vector<std::byte> bytes;
};

// The mesh of a cell. An inner cell may have none: no triangles, no parts.
struct MeshFigures {
  uint64_t triangles = 0;
  double errorSteps = 0;  // geometric error in steps of the model's grid
  uint32_t parts = 0;
  uint32_t bytes = 0;  // of all parts, at most 2^32 - 1
};

// Some views of a cell: pairs [first, first + count) of view and antipode, of Viewpoints' pairs in rising order.
struct ViewBatch {
  uint32_t cell = 0;
  uint32_t firstPair = 0;
  uint32_t pairCount = 0;
};

class CellStore {
 public:
  // `writer`: the number of this process.
  static Result<std::unique_ptr<CellStore>> open(const std::filesystem::path& workDirectory, uint32_t writer);

  // Any thread. Of a part, mesh or batch that is there already the first stays: both are the same.
  // A mesh goes in part by part, however many it has, and is there once its figures are.
  Result<> add(uint32_t cell, uint32_t part, const CodedPart& coded);
  Result<> add(uint32_t cell, const MeshFigures& mesh);
  // Of a leaf with textures besides: a part with colours in place of its atlas, from which the meshes of inner cells
  // are made; pages of its atlases, by PageRecord::group.
  Result<> addColoured(uint32_t cell, uint32_t part, const CodedPart& coded);
  Result<> addTexture(uint32_t cell, uint32_t group, const CodedPart& coded);
  // baked: what became of each view of the batch that is wanted; views: those that are not empty, by rising view.
  Result<> add(const ViewBatch& batch, std::span<const ViewCost> baked, std::span<const EncodedView> views);
  Result<> addErrors(uint32_t cell, CellErrors errors);
  Result<> addCandidates(uint32_t cell, CellCandidates candidates);
  bool hasMesh(uint32_t cell) const;
  bool hasErrors(uint32_t cell) const;
  bool hasCandidates(uint32_t cell) const;
  bool has(const ViewBatch& batch) const;
  MeshFigures meshFigures(uint32_t cell) const;                    // REQUIRES: hasMesh
  Result<CodedPart> part(uint32_t cell, uint32_t part) const;      // REQUIRES: hasMesh, part < meshFigures(cell).parts
  Result<CodedPart> coloured(uint32_t cell, uint32_t part) const;  // the same, or that part when it has no atlas
  std::vector<uint32_t> textureGroups(uint32_t cell) const;        // rising; REQUIRES: hasMesh
  Result<CodedPart> texture(uint32_t cell, uint32_t group) const;  // REQUIRES: one of these
  // Those that are not empty, by rising view.
  Result<std::vector<EncodedView>> views(uint32_t cell) const;

  Result<> sync() { return journal_->sync(); }
  // What other processes have added since.
  Result<> refresh() { return journal_->refresh(); }
  // Of all views that were baked, by cell, then view. Call it when nothing is added any more.
  std::vector<ViewCost> viewCosts() const;
  // Of the cells that were measured.
  std::map<uint32_t, CellErrors> errors() const;
  std::map<uint32_t, CellCandidates> candidates() const;

 private:
  enum class Kind : uint32_t { part = 1, mesh = 2, views = 3, errors = 4, coloured = 5, texture = 6, candidates = 7 };
  struct StoredPart {
    uint32_t decodedBytes = 0;
    JournalPlace place;
  };

  CellStore() = default;
  Result<> addPart(Kind kind, uint32_t cell, uint32_t part, const CodedPart& coded);
  Result<CodedPart> read(const StoredPart& stored) const;
  void found(const JournalRecord& record, std::span<const std::byte> head, const JournalPlace& place);
  void foundViews(uint32_t cell, std::span<const std::byte> head);
  void foundErrors(uint32_t cell, std::span<const std::byte> head);
  void foundCandidates(uint32_t cell, std::span<const std::byte> head);

  mutable std::mutex mutex_;
  // Guarded by mutex_ while something is added:
  std::map<uint64_t, StoredPart> parts_;  // by cell, then part
  std::map<uint64_t, StoredPart> coloured_;
  std::map<uint64_t, StoredPart> textures_;  // by cell, then group
  std::map<uint32_t, MeshFigures> meshes_;
  std::map<uint64_t, JournalPlace> batches_;  // by cell, then first pair
  std::vector<ViewCost> views_;
  std::map<uint32_t, CellErrors> errors_;
  std::map<uint32_t, CellCandidates> candidates_;
  std::unique_ptr<Journal> journal_;  // the last: its sink fills the others
};

}  // namespace farcell
