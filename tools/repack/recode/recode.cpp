#include "tools/repack/recode/recode.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "cache/base/interrupt.h"
#include "cache/base/parallel.h"
#include "cache/pack/encoded_view.h"

namespace farcell {
namespace {

constexpr uint64_t kBatchBytes = uint64_t{64} << 20;  // of decoded pages that are worked on together

struct RecodedPage {
  std::vector<std::byte> bytes;
  // Views that share another's stream, now and before, and what they would take now.
  uint32_t duplicates = 0;
  uint32_t duplicatesBefore = 0;
  uint64_t duplicateBytes = 0;
};

class Recoder {
 public:
  explicit Recoder(const PackFile& pack) : pack_(pack) {}

  Result<RecodedPage> recoded(uint32_t page) const {
    FARCELL_TRY(checkInterrupt());
    switch (pack_.directory().pages[page].kind) {
      case PageKind::geometry:
        return geometry(page);
      case PageKind::views:
        return views(page);
      case PageKind::texture:
        break;
    }
    return texture(page);
  }

 private:
  tl::unexpected<Error> differs(uint32_t page) const {
    return fail(ErrorKind::corrupt, "{}: page {}: expected to decode as before, found other content", pack_.path(),
                page);
  }

  Result<RecodedPage> geometry(uint32_t page) const {
    const Directory& directory = pack_.directory();
    const PageRecord& record = directory.pages[page];
    const auto level = static_cast<int>(directory.cells[record.cell].key.level);
    const GeometryLimits limits{1u << (directory.model.grid.bits - level), record.decodedBytes};
    FARCELL_ASSIGN(const GeometryPage before, pack_.readGeometry(page));
    FARCELL_ASSIGN(const std::vector<std::byte> stored, pack_.readStored(page));
    FARCELL_ASSIGN(std::vector<std::byte> bytes, smallerGeometryPage(stored, limits));
    if (decodeGeometryPage(bytes, limits) != before) return differs(page);
    return RecodedPage{.bytes = std::move(bytes)};
  }

  Result<RecodedPage> texture(uint32_t page) const {
    const TextureLimits limits{pack_.directory().pages[page].decodedBytes};
    FARCELL_ASSIGN(const TexturePage before, pack_.readTexture(page));
    FARCELL_ASSIGN(const std::vector<std::byte> stored, pack_.readStored(page));
    FARCELL_ASSIGN(std::vector<std::byte> bytes, smallerTexturePage(stored, limits));
    if (decodeTexturePage(bytes, limits) != before) return differs(page);
    return RecodedPage{.bytes = std::move(bytes)};
  }

  Result<RecodedPage> views(uint32_t page) const {
    const ViewLimits limits = pack_.viewLimits(page);
    FARCELL_ASSIGN(const ViewPage before, pack_.readViews(page));
    FARCELL_ASSIGN(const std::vector<std::byte> stored, pack_.readStored(page));
    FARCELL_ASSIGN(std::vector<EncodedView> views, viewsOfPage(stored, limits));
    RecodedPage result{.bytes = {}, .duplicatesBefore = viewPageOf(views).duplicates};
    for (EncodedView& view : views) {
      FARCELL_TRY(checkInterrupt());
      FARCELL_ASSIGN(view, smallerView(view));
    }
    EncodedViewPage coded = viewPageOf(views);
    if (decodeViewPage(coded.bytes, limits) != before) return differs(page);
    result.bytes = std::move(coded.bytes);
    result.duplicates = coded.duplicates;
    result.duplicateBytes = coded.duplicateBytes;
    return result;
  }

  const PackFile& pack_;
};

// Pages from `first` that are worked on together: at least one.
uint32_t batchEnd(const std::vector<PageRecord>& pages, uint32_t first) {
  uint64_t bytes = pages[first].decodedBytes;
  uint32_t end = first + 1;
  while (end < pages.size() && bytes + pages[end].decodedBytes <= kBatchBytes) bytes += pages[end++].decodedBytes;
  return end;
}

uint64_t& bytesOf(PageKind kind, PackBytes& bytes) {
  return kind == PageKind::views ? bytes.impostors : kind == PageKind::geometry ? bytes.geometry : bytes.textures;
}

// Counts of the report that the pages decide.
void count(const RecodedPage& page, BuildReport& report) {
  report.viewsKept += page.duplicatesBefore;
  report.viewsKept -= page.duplicates;
  if (page.duplicates == 0) return;
  report.viewsLeftOut["duplicate"] += page.duplicates;
  report.bytesLeftOut["duplicate"] += page.duplicateBytes;
}

}  // namespace

Result<RecodeResult> recodePack(const PackFile& pack, const std::filesystem::path& output, int threads,
                                Progress& progress) {
  FARCELL_ASSIGN(PackWriter writer, PackWriter::create(output));
  Directory directory = pack.directory();
  const std::vector<PageRecord>& pages = pack.directory().pages;
  for (auto* leftOut : {&directory.report.viewsLeftOut, &directory.report.bytesLeftOut}) leftOut->erase("duplicate");
  const Recoder recoder(pack);
  RecodeResult result;
  result.pages = pages.size();
  progress.begin("repack", pages.size(), "pages");
  for (uint32_t first = 0; first < pages.size();) {
    const uint32_t end = batchEnd(pages, first);
    std::vector<Result<RecodedPage>> batch(end - first);
    parallelFor(batch.size(), threadCount(threads), [&](size_t index, int) {
      batch[index] = recoder.recoded(first + static_cast<uint32_t>(index));
      progress.advance();
    });
    for (uint32_t page = first; page < end; ++page) {
      const Result<RecodedPage>& recoded = batch[page - first];
      if (!recoded) return tl::unexpected<Error>(recoded.error());
      const PageRecord& record = pages[page];
      FARCELL_TRY(writer.add(record.kind, record.cell, record.group, record.decodedBytes, recoded->bytes));
      count(*recoded, directory.report);
      bytesOf(record.kind, result.after) += recoded->bytes.size();
    }
    first = end;
  }
  result.before = {pack.sizeBytes(), directory.report.impostorBytes, directory.report.geometryBytes,
                   directory.report.textureBytes};
  FARCELL_ASSIGN(result.after.pack, writer.finish(std::move(directory)));
  progress.end();
  return result;
}

}  // namespace farcell
