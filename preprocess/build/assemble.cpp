#include "preprocess/build/assemble.h"

#include "cache/base/check.h"
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
    return {};
  }

  // Of cells in rising order, each once.
  Result<> views(uint32_t cell) {
    FARCELL_ASSIGN(std::vector<EncodedView> stored, context_.store.views(cell));
    std::vector<std::vector<EncodedView>> groups(static_cast<size_t>(context_.viewpoints.groupCount()));
    auto next = stored.begin();
    for (; cursor_ < costs_.size() && costs_[cursor_].cell == cell; ++cursor_) {
      const ViewCost& cost = costs_[cursor_];
      if (cost.texels == 0) continue;
      FARCELL_CHECK(next != stored.end() && next->view == cost.view);
      if (fates_[cursor_] == ViewFate::kept)
        groups[static_cast<size_t>(context_.viewpoints.group(static_cast<int>(cost.view)))].push_back(std::move(*next));
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
  size_t cursor_ = 0;  // in costs_
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
