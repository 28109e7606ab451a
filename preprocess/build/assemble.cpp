#include "preprocess/build/assemble.h"

#include <algorithm>
#include <array>
#include <map>

#include "cache/base/check.h"
#include "cache/base/hash.h"
#include "cache/base/interrupt.h"
#include "cache/pack/pack_file.h"

namespace farcell {
namespace {

class Assembly {
 public:
  Assembly(const BuildContext& context, std::span<const ViewCost> costs, std::span<const ViewFate> fates,
           PackWriter& writer, Directory& directory)
      : context_(context), costs_(costs), fates_(fates), writer_(writer), directory_(directory) {}

  Result<> mesh(uint32_t cell) {
    CellRecord& record = directory_.cells[cell];
    const MeshFigures mesh = context_.store.meshFigures(cell);
    record.meshTriangles = mesh.triangles;
    for (uint32_t index = 0; index < mesh.parts; ++index) {
      FARCELL_ASSIGN(const CodedPart part, context_.store.part(cell, index));
      FARCELL_ASSIGN(const uint32_t page,
                     writer_.add(PageKind::geometry, cell, record.geometryPageCount, part.decodedBytes, part.bytes));
      if (record.geometryPageCount++ == 0) record.firstGeometryPage = page;
      directory_.report.geometryBytes += part.bytes.size();
    }
    return textures(cell);
  }

  // Of cells in rising order, each once.
  Result<> views(uint32_t cell) {
    FARCELL_ASSIGN(std::vector<EncodedView> stored, context_.store.views(cell));
    const Viewpoints& viewpoints = context_.viewpoints(cell);
    std::vector<std::vector<EncodedView>> groups(static_cast<size_t>(viewpoints.groupCount()));
    auto next = stored.begin();
    for (; cursor_ < costs_.size() && costs_[cursor_].cell == cell; ++cursor_) {
      const ViewCost& cost = costs_[cursor_];
      if (cost.texels == 0) continue;
      FARCELL_CHECK(next != stored.end() && next->view == cost.view);
      if (fates_[cursor_] == ViewFate::kept)
        groups[static_cast<size_t>(viewpoints.group(static_cast<int>(cost.view)))].push_back(std::move(*next));
      ++next;
    }
    for (uint32_t group = 0; group < groups.size(); ++group)
      if (!groups[group].empty()) FARCELL_TRY(viewPage(cell, group, groups[group]));
    CellRecord& record = directory_.cells[cell];
    if (record.viewPageCount == 0) forget(record.errors);
    return {};
  }

 private:
  // Of views that were left out.
  static void forget(ErrorTable& errors) {
    for (const ErrorWay way : {ErrorWay::depthCorrected, ErrorWay::blended})
      errors.codes[static_cast<size_t>(way)] = {};
  }

  // Those of a cell before it, where they are the same.
  Result<> textures(uint32_t cell) {
    CellRecord& record = directory_.cells[cell];
    std::vector<CodedPart> pages;
    uint64_t hash = 0;
    const std::vector<uint32_t> groups = context_.store.textureGroups(cell);
    for (const uint32_t group : groups) {
      FARCELL_ASSIGN(CodedPart page, context_.store.texture(cell, group));
      const std::array<uint64_t, 3> chain = {hash, group, hashBytes(page.bytes)};
      hash = hashBytes(std::as_bytes(std::span(chain)));
      pages.push_back(std::move(page));
    }
    if (pages.empty()) return {};
    record.texturePageCount = static_cast<uint32_t>(pages.size());
    const auto [first, last] = atlases_.equal_range(hash);
    for (auto earlier = first; earlier != last; ++earlier) {
      FARCELL_ASSIGN(const bool same, sameTextures(earlier->second, groups, pages));
      if (!same) continue;
      record.firstTexturePage = directory_.cells[earlier->second].firstTexturePage;
      return {};
    }
    atlases_.emplace(hash, cell);
    for (size_t i = 0; i < pages.size(); ++i) {
      FARCELL_ASSIGN(const uint32_t page,
                     writer_.add(PageKind::texture, cell, groups[i], pages[i].decodedBytes, pages[i].bytes));
      if (i == 0) record.firstTexturePage = page;
      directory_.report.textureBytes += pages[i].bytes.size();
    }
    return {};
  }

  Result<bool> sameTextures(uint32_t cell, std::span<const uint32_t> groups, std::span<const CodedPart> pages) const {
    if (!std::ranges::equal(context_.store.textureGroups(cell), groups)) return false;
    for (size_t i = 0; i < groups.size(); ++i) {
      FARCELL_ASSIGN(const CodedPart page, context_.store.texture(cell, groups[i]));
      if (page.bytes != pages[i].bytes) return false;
    }
    return true;
  }

  Result<> viewPage(uint32_t cell, uint32_t group, std::span<const EncodedView> views) {
    const EncodedViewPage page = viewPageOf(views);
    FARCELL_ASSIGN(const uint32_t index,
                   writer_.add(PageKind::views, cell, group, decodedSizeBytes(views), page.bytes));
    CellRecord& record = directory_.cells[cell];
    if (record.viewPageCount++ == 0) record.firstViewPage = index;
    BuildReport& report = directory_.report;
    report.impostorBytes += page.bytes.size();
    report.viewsKept += views.size() - page.duplicates;
    for (const EncodedView& view : views) report.impostorRawBytes += view.decodedBytes;
    if (page.duplicates == 0) return {};
    report.viewsLeftOut["duplicate"] += page.duplicates;
    report.bytesLeftOut["duplicate"] += page.duplicateBytes;
    return {};
  }

  const BuildContext& context_;
  const std::span<const ViewCost> costs_;
  const std::span<const ViewFate> fates_;
  PackWriter& writer_;
  Directory& directory_;
  size_t cursor_ = 0;                          // in costs_
  std::multimap<uint64_t, uint32_t> atlases_;  // cells whose textures are in the pack, by their hash
};

}  // namespace

Result<uint64_t> assemblePack(const BuildContext& context, const std::filesystem::path& pack,
                              std::span<const ViewCost> views, std::span<const ViewFate> fates, Directory& directory,
                              Progress& progress) {
  FARCELL_ASSIGN(PackWriter writer, PackWriter::create(pack));
  Assembly assembly(context, views, fates, writer, directory);
  progress.begin("write", directory.cells.size(), "cells");
  for (uint32_t cell = 0; cell < directory.cells.size(); ++cell) {
    FARCELL_TRY(checkInterrupt());
    FARCELL_TRY(assembly.mesh(cell));
    FARCELL_TRY(assembly.views(cell));
    progress.advance();
  }
  return writer.finish(directory);
}

}  // namespace farcell
