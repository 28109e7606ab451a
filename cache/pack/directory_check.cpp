#include "cache/pack/directory_check.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "cache/pack/layout.h"
#include "cache/pack/pack_file.h"
#include "cache/pack/pages.h"
#include "cache/pack/zlib_stream.h"
#include "cache/schema/viewpoints.h"

namespace farcell {
namespace {

constexpr uint64_t kMaxWordsRatio = 12;                    // a triangle of 12 bytes may be one byte before deflate
constexpr uint64_t kMaxMeshTriangles = uint64_t{1} << 40;  // all parts have a number

std::string text(const CellKey& key) { return fmt::format("level {} ({}, {}, {})", key.level, key.x, key.y, key.z); }

std::string text(const GridBox& box) {
  return fmt::format("({}, {}, {}) to ({}, {}, {})", box.min.x, box.min.y, box.min.z, box.max.x, box.max.y, box.max.z);
}

constexpr const char* kForms = "a set of viewpoints and an image size of 16 to 1024, a power of two";

std::string text(const ViewForm& form) { return fmt::format("{} views of {} texels", form.views, form.imageSize); }

bool contains(const GridBox& outer, const GridBox& inner) {
  for (int axis = 0; axis < 3; ++axis)
    if (inner.min[axis] < outer.min[axis] || inner.max[axis] > outer.max[axis]) return false;
  return true;
}

bool keyInside(const CellKey& key) {
  const uint32_t side = 1u << key.level;
  return key.x < side && key.y < side && key.z < side;
}

bool finite(glm::dvec3 v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }

// Carries what every check needs to say where and what.
class Checker {
 public:
  Checker(const Directory& directory, const DirectoryPlaces& places, uint64_t directoryOffset, const std::string& path)
      : directory_(directory), places_(places), directoryOffset_(directoryOffset), path_(path) {}

  Result<> all() {
    FARCELL_TRY(grid());
    FARCELL_TRY(settings());
    FARCELL_TRY(tree());
    for (uint32_t i = 0; i < directory_.cells.size(); ++i) FARCELL_TRY(content(i));
    for (uint32_t i = 0; i < directory_.cells.size(); ++i) FARCELL_TRY(cellPages(i));
    FARCELL_TRY(pages());
    return reportedBytes();
  }

 private:
  tl::unexpected<Error> wrongModel(const std::string& expected, const std::string& found) const {
    return corrupt(path_, places_.model, expected, found);
  }
  tl::unexpected<Error> wrongCell(uint32_t cell, const std::string& expected, const std::string& found) const {
    return corrupt(path_, places_.cells + cell * kCellRecordBytes, fmt::format("cell {}: {}", cell, expected), found);
  }
  tl::unexpected<Error> wrongPage(uint32_t page, const std::string& expected, const std::string& found) const {
    return corrupt(path_, places_.pages + page * kPageRecordBytes, fmt::format("page {}: {}", page, expected), found);
  }

  Result<> grid() const {
    const Grid& grid = directory_.model.grid;
    const GridBox& bounds = directory_.model.bounds;
    if (!finite(grid.origin) || !std::isfinite(grid.side) || !(grid.side > 0) || !finite(grid.origin + grid.side) ||
        !(std::ldexp(grid.side, -kMaxGridBits) > 0))
      return wrongModel("a finite grid with a side above 0", fmt::format("origin {}, {}, {}, side {}", grid.origin.x,
                                                                         grid.origin.y, grid.origin.z, grid.side));
    if (grid.bits < kMinGridBits || grid.bits > kMaxGridBits)
      return wrongModel(fmt::format("a grid of {} to {} bits", kMinGridBits, kMaxGridBits),
                        fmt::format("{}", grid.bits));
    if (!bounds.empty() && !contains(cellBox(grid, {}), bounds))
      return wrongModel("bounds inside the root cube", text(bounds));
    return {};
  }

  Result<> settings() const {
    const BuildSettings& s = directory_.model.settings;
    if (!isViewForm(s.form)) return wrongModel(kForms, text(s.form));
    if (s.forms > Forms::byHeight)
      return wrongModel("forms of 0 to 2", fmt::format("{}", static_cast<uint32_t>(s.forms)));
    if (s.samples != 1 && s.samples != 4 && s.samples != 16 && s.samples != 64)
      return wrongModel("1, 4, 16 or 64 samples", fmt::format("{}", s.samples));
    if (s.leafTriangles < 1) return wrongModel("at least 1 triangle a leaf", fmt::format("{}", s.leafTriangles));
    if (s.maxLevel < 0 || s.maxLevel > kMaxLevel || s.fixedLevel < -1 || s.fixedLevel > kMaxLevel)
      return wrongModel(fmt::format("levels up to {}", kMaxLevel), fmt::format("{} and {}", s.maxLevel, s.fixedLevel));
    if (s.viewError < 0 || s.viewError > kMaxViewError)
      return wrongModel(fmt::format("an error of views of 0 to {}", kMaxViewError), fmt::format("{}", s.viewError));
    if (s.up > UpAxis::z) return wrongModel("an up axis of 0 to 2", fmt::format("{}", static_cast<uint32_t>(s.up)));
    if (!std::isfinite(s.metresPerUnit) || !(s.metresPerUnit > 0))
      return wrongModel("a unit above 0 metres", fmt::format("{}", s.metresPerUnit));
    if (s.lighting > Lighting::relightable)
      return wrongModel("a lighting of 0 or 1", fmt::format("{}", static_cast<int>(s.lighting)));
    if (!isSun(s.sun))
      return wrongModel("a sun within a turn and a quarter of one",
                        fmt::format("{}, {}", s.sun.azimuthRad, s.sun.elevationRad));
    if (s.measure > Measure::all)
      return wrongModel("measuring of 0 to 2", fmt::format("{}", static_cast<int>(s.measure)));
    if (s.simplifier > Simplifier::openmesh || s.budgetRule > BudgetRule::triangles)
      return wrongModel(
          "a simplifier and a budget rule of 0 or 1",
          fmt::format("{}, {}", static_cast<uint32_t>(s.simplifier), static_cast<uint32_t>(s.budgetRule)));
    return {};
  }

  // Children follow each other in the order of their parents: together with rising keys that leaves one tree only.
  Result<> tree() const {
    const auto& cells = directory_.cells;
    if (cells.empty()) return corrupt(path_, places_.cells, "a root cell", "no cells");
    if (cells[0].key != CellKey{}) return wrongCell(0, text(CellKey{}), text(cells[0].key));
    if (cells[0].parent != kNone) return wrongCell(0, "no parent", fmt::format("{}", cells[0].parent));
    uint64_t nextChild = 1;
    for (uint32_t i = 0; i < cells.size(); ++i) {
      const CellRecord& cell = cells[i];
      const uint64_t firstChild = cell.childCount == 0 ? uint64_t{kNone} : nextChild;
      if (cell.childCount > 8 || cell.firstChild != firstChild || cell.childCount > cells.size() - nextChild)
        return wrongCell(i, fmt::format("up to 8 of {} cells as children from {}", cells.size(), firstChild),
                         fmt::format("{} from {}", cell.childCount, cell.firstChild));
      for (uint32_t child = 0; child < cell.childCount; ++child)
        FARCELL_TRY(link(i, static_cast<uint32_t>(nextChild + child)));
      nextChild += cell.childCount;
    }
    if (nextChild != cells.size())
      return wrongCell(static_cast<uint32_t>(nextChild), "a cell that is another's child", "an orphan");
    return {};
  }

  Result<> link(uint32_t parent, uint32_t child) const {
    const auto& cells = directory_.cells;
    const CellRecord& cell = cells[child];
    if (cell.parent != parent)
      return wrongCell(child, fmt::format("parent {}", parent), fmt::format("{}", cell.parent));
    if (cell.key.level > kMaxLevel || !keyInside(cell.key) || cell.key.level != cells[parent].key.level + 1 ||
        cell.key.parent() != cells[parent].key)
      return wrongCell(child, fmt::format("a child of {}, level up to {}", text(cells[parent].key), kMaxLevel),
                       text(cell.key));
    const CellRecord& before = cells[child - 1];
    if (before.key.level == cell.key.level && mortonCode(before.key) >= mortonCode(cell.key))
      return wrongCell(child, fmt::format("a cell after {}", text(before.key)), text(cell.key));
    return {};
  }

  Result<> content(uint32_t i) const {
    const CellRecord& cell = directory_.cells[i];
    if (cell.content.empty()) {
      if (cell.triangles == 0) return {};
      return wrongCell(i, fmt::format("a box around {} triangles", cell.triangles), "an empty one");
    }
    const GridBox cube = cellBox(directory_.model.grid, cell.key);
    const GridBox& outer = i == 0 ? cube : directory_.cells[cell.parent].content;
    if (!contains(cube, cell.content) || !contains(outer, cell.content))
      return wrongCell(i, fmt::format("content inside its cube {} and its parent's {}", text(cube), text(outer)),
                       text(cell.content));
    return {};
  }

  Result<> cellPages(uint32_t i) const {
    FARCELL_TRY(mesh(i));
    const CellRecord& cell = directory_.cells[i];
    const uint64_t pageCount = directory_.pages.size();
    FARCELL_TRY(form(i));
    const bool hasViews = cell.viewPageCount > 0;
    if (hasViews != (cell.firstViewPage != kNone) ||
        (hasViews && uint64_t{cell.firstViewPage} + cell.viewPageCount > pageCount))
      return wrongCell(i, fmt::format("pages of views below {}", pageCount),
                       fmt::format("{} from {}", cell.viewPageCount, cell.firstViewPage));
    for (uint32_t page = cell.firstViewPage; page < cell.firstViewPage + cell.viewPageCount; ++page)
      if (!isOf(page, PageKind::views, i)) return wrongCell(i, "pages of its own views", fmt::format("page {}", page));
    FARCELL_TRY(textures(i));
    return errors(i);
  }

  Result<> form(uint32_t i) const {
    const ViewForm& form = directory_.cells[i].form;
    const BuildSettings& settings = directory_.model.settings;
    if (!isViewForm(form)) return wrongCell(i, kForms, text(form));
    if (settings.forms == Forms::fixed && form != settings.form) return wrongCell(i, text(settings.form), text(form));
    return {};
  }

  // A leaf's, or all of those of one before it.
  Result<> textures(uint32_t i) const {
    const CellRecord& cell = directory_.cells[i];
    const uint64_t pageCount = directory_.pages.size();
    const bool there = cell.texturePageCount > 0;
    if (there != (cell.firstTexturePage != kNone) || (there && cell.childCount > 0) ||
        (there && uint64_t{cell.firstTexturePage} + cell.texturePageCount > pageCount))
      return wrongCell(i, fmt::format("pages of textures below {}, of leaves only", pageCount),
                       fmt::format("{} from {}", cell.texturePageCount, cell.firstTexturePage));
    if (!there) return {};
    const uint32_t owner = directory_.pages[cell.firstTexturePage].cell;
    if (owner > i || directory_.cells[owner].firstTexturePage != cell.firstTexturePage ||
        directory_.cells[owner].texturePageCount != cell.texturePageCount)
      return wrongCell(i, "all pages of textures of its own or of a cell before it", fmt::format("those of {}", owner));
    for (uint32_t page = 0; page < cell.texturePageCount; ++page) {
      const uint32_t index = cell.firstTexturePage + page;
      const uint32_t group = directory_.pages[index].group, before = page > 0 ? directory_.pages[index - 1].group : 0;
      const bool follows = group % kAtlasGroups > 0 ? page > 0 && group == before + 1
                                                    : page == 0 || group / kAtlasGroups > before / kAtlasGroups;
      if (!isOf(index, PageKind::texture, owner) || !follows || group / kAtlasGroups >= cell.geometryPageCount)
        return wrongCell(i, "pages of textures of its parts, from group 0 on", fmt::format("page {}", index));
    }
    return {};
  }

  // A way to draw the cell that is known, is at every scale, and is there.
  Result<> errors(uint32_t i) const {
    const CellRecord& cell = directory_.cells[i];
    const bool measured = directory_.model.settings.measure != Measure::off;
    for (size_t way = 0; way < kErrorWays; ++way) {
      const bool there = way == static_cast<size_t>(ErrorWay::mesh) ? cell.meshTriangles > 0 : cell.viewPageCount > 0;
      const auto& codes = cell.errors.codes[way];
      const auto known =
          static_cast<size_t>(std::count_if(codes.begin(), codes.end(), [](uint8_t c) { return c > 0; }));
      if (known > 0 && (known < kErrorScales || !there || !measured))
        return wrongCell(i, fmt::format("{} errors of way {}", there && measured ? "0 or 4" : "no", way),
                         fmt::format("{}", known));
    }
    return {};
  }

  Result<> mesh(uint32_t i) const {
    const CellRecord& cell = directory_.cells[i];
    const bool leaf = cell.childCount == 0;
    if (leaf ? cell.meshTriangles != cell.triangles : cell.meshTriangles > kMaxMeshTriangles)
      return wrongCell(i,
                       fmt::format("{} {} triangles in its mesh", leaf ? "all" : "at most",
                                   leaf ? cell.triangles : kMaxMeshTriangles),
                       fmt::format("{}", cell.meshTriangles));
    if (!(cell.geometricError >= 0) || !std::isfinite(cell.geometricError) || (leaf && cell.geometricError != 0))
      return wrongCell(i, leaf ? "no geometric error" : "a finite geometric error from 0",
                       fmt::format("{}", cell.geometricError));
    const uint64_t parts = partCount(cell.meshTriangles);
    if (cell.geometryPageCount != parts || (parts == 0) != (cell.firstGeometryPage == kNone))
      return wrongCell(i, fmt::format("{} pages for {} triangles", parts, cell.meshTriangles),
                       fmt::format("{} from {}", cell.geometryPageCount, cell.firstGeometryPage));
    for (uint64_t part = 0; part < parts; ++part) {
      const uint64_t page = cell.firstGeometryPage + part;
      if (!isOf(page, PageKind::geometry, i) || directory_.pages[page].group != part)
        return wrongCell(i, "pages of its own geometry, by part", fmt::format("page {}", page));
    }
    return {};
  }

  bool isOf(uint64_t page, PageKind kind, uint32_t cell) const {
    return page < directory_.pages.size() && directory_.pages[page].kind == kind && directory_.pages[page].cell == cell;
  }

  Result<> pages() const {
    uint64_t offset = kHeaderBytes;
    for (uint32_t i = 0; i < directory_.pages.size(); ++i) {
      const PageRecord& page = directory_.pages[i];
      if (page.offsetBytes != offset || page.storedBytes == 0 || page.storedBytes > directoryOffset_ - offset)
        return wrongPage(i, fmt::format("1 to {} bytes at offset {}", directoryOffset_ - offset, offset),
                         fmt::format("{} at {}", page.storedBytes, page.offsetBytes));
      const uint64_t mostDecoded = page.storedBytes * kMaxZlibRatio * kMaxWordsRatio;
      if (page.decodedBytes > mostDecoded)
        return wrongPage(i, fmt::format("at most {} decoded bytes", mostDecoded), fmt::format("{}", page.decodedBytes));
      FARCELL_TRY(owner(i));
      offset += page.storedBytes;
    }
    if (offset != directoryOffset_)
      return corrupt(path_, directoryOffset_, "pages up to the directory", fmt::format("up to {}", offset));
    return {};
  }

  // The page is of a known kind and its cell names it.
  Result<> owner(uint32_t i) const {
    const PageRecord& page = directory_.pages[i];
    if (page.cell >= directory_.cells.size())
      return wrongPage(i, fmt::format("a cell below {}", directory_.cells.size()), fmt::format("{}", page.cell));
    const CellRecord& cell = directory_.cells[page.cell];
    if (page.kind == PageKind::geometry) return among(i, "geometry", cell.firstGeometryPage, cell.geometryPageCount);
    if (page.kind == PageKind::texture) return among(i, "textures", cell.firstTexturePage, cell.texturePageCount);
    if (page.kind != PageKind::views)
      return wrongPage(i, "kind 1, 2 or 3", fmt::format("{}", static_cast<uint32_t>(page.kind)));
    FARCELL_TRY(among(i, "views", cell.firstViewPage, cell.viewPageCount));
    const auto groupCount = static_cast<uint32_t>(Viewpoints::of(cell.form.views).groupCount());
    const bool rising = i == cell.firstViewPage || directory_.pages[i - 1].group < page.group;
    if (page.group >= groupCount || !rising)
      return wrongPage(i, fmt::format("a rising group below {}", groupCount), fmt::format("{}", page.group));
    return {};
  }

  // The pages that its cell names.
  Result<> among(uint32_t i, const char* what, uint32_t first, uint32_t count) const {
    if (i >= first && i - first < count) return {};
    return wrongPage(i, fmt::format("{} pages of {} of cell {} from {}", count, what, directory_.pages[i].cell, first),
                     fmt::format("page {}", i));
  }

  Result<> reportedBytes() const {
    const BuildReport& report = directory_.report;
    const PageBytes bytes = pageBytes(directory_.pages);
    if (report.impostorBytes == bytes.views && report.geometryBytes == bytes.geometry &&
        report.textureBytes == bytes.textures)
      return {};
    return wrongModel(
        fmt::format("{} bytes of views, {} of geometry, {} of textures", bytes.views, bytes.geometry, bytes.textures),
        fmt::format("{}, {}, {}", report.impostorBytes, report.geometryBytes, report.textureBytes));
  }

  const Directory& directory_;
  const DirectoryPlaces& places_;
  const uint64_t directoryOffset_;
  const std::string& path_;
};

}  // namespace

PageBytes pageBytes(std::span<const PageRecord> pages) {
  PageBytes bytes;
  for (const PageRecord& page : pages)
    (page.kind == PageKind::views      ? bytes.views
     : page.kind == PageKind::geometry ? bytes.geometry
                                       : bytes.textures) += page.storedBytes;
  return bytes;
}

Result<> checkDirectory(const Directory& directory, const DirectoryPlaces& places, uint64_t directoryOffset,
                        const std::string& path) {
  return Checker(directory, places, directoryOffset, path).all();
}

}  // namespace farcell
