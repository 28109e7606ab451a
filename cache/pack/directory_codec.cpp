#include "cache/pack/directory_codec.h"

#include "cache/base/check.h"
#include "cache/base/hash.h"
#include "cache/pack/bytes.h"

namespace farcell {
namespace {

constexpr uint32_t kHasNormals = 1;
constexpr uint32_t kHasColours = 2;
constexpr uint32_t kHasSides = 4;

using Counts = std::map<std::string, uint64_t>;

void write(ByteWriter& out, const GridBox& box) {
  for (const GridPoint& corner : {box.min, box.max})
    for (int axis = 0; axis < 3; ++axis) out.i32(corner[axis]);
}

GridBox readBox(ByteReader& in) {
  GridBox box;
  for (GridPoint* corner : {&box.min, &box.max})
    for (int axis = 0; axis < 3; ++axis) (*corner)[axis] = in.i32();
  return box;
}

void write(ByteWriter& out, const BuildSettings& settings) {
  for (const int value : {settings.form.views, settings.form.imageSize, settings.samples, settings.leafTriangles,
                          settings.maxLevel, settings.fixedLevel})
    out.i32(value);
  out.u32(static_cast<uint32_t>(settings.up));
  out.u8(static_cast<uint8_t>(settings.lighting));
  out.u8(static_cast<uint8_t>(settings.measure));
  out.u16(static_cast<uint16_t>(settings.viewError));
  out.f64(settings.metresPerUnit);
  out.u32(static_cast<uint32_t>(settings.simplifier));
  out.u16(static_cast<uint16_t>(settings.budgetRule));
  out.u16(static_cast<uint16_t>(settings.forms));
  out.u64(settings.packBudgetBytes);
  out.u64(settings.visitableHash);
  out.f64(settings.sun.azimuthRad);
  out.f64(settings.sun.elevationRad);
}

BuildSettings readSettings(ByteReader& in) {
  BuildSettings settings;
  for (int* value : {&settings.form.views, &settings.form.imageSize, &settings.samples, &settings.leafTriangles,
                     &settings.maxLevel, &settings.fixedLevel})
    *value = in.i32();
  settings.up = static_cast<UpAxis>(in.u32());
  settings.lighting = static_cast<Lighting>(in.u8());
  settings.measure = static_cast<Measure>(in.u8());
  settings.viewError = in.u16();
  settings.metresPerUnit = in.f64();
  settings.simplifier = static_cast<Simplifier>(in.u32());
  settings.budgetRule = static_cast<BudgetRule>(in.u16());
  settings.forms = static_cast<Forms>(in.u16());
  settings.packBudgetBytes = in.u64();
  settings.visitableHash = in.u64();
  settings.sun.azimuthRad = in.f64();
  settings.sun.elevationRad = in.f64();
  return settings;
}

void write(ByteWriter& out, const Model& model) {
  for (int axis = 0; axis < 3; ++axis) out.f64(model.grid.origin[axis]);
  out.f64(model.grid.side);
  out.i32(model.grid.bits);
  out.u32((model.hasNormals ? kHasNormals : 0) | (model.hasColours ? kHasColours : 0) |
          (model.hasSides ? kHasSides : 0));
  write(out, model.bounds);
  write(out, model.settings);
}

Model readModel(ByteReader& in, bool& valid) {
  Model model;
  for (int axis = 0; axis < 3; ++axis) model.grid.origin[axis] = in.f64();
  model.grid.side = in.f64();
  model.grid.bits = in.i32();
  const uint32_t flags = in.u32();
  valid = valid && (flags & ~(kHasNormals | kHasColours | kHasSides)) == 0;
  model.hasNormals = (flags & kHasNormals) != 0;
  model.hasColours = (flags & kHasColours) != 0;
  model.hasSides = (flags & kHasSides) != 0;
  valid = valid && (model.hasColours || !model.hasSides);
  model.bounds = readBox(in);
  model.settings = readSettings(in);
  return model;
}

void write(ByteWriter& out, const Counts& counts) {
  FARCELL_CHECK(counts.size() <= kMaxReasons);
  out.u32(static_cast<uint32_t>(counts.size()));
  for (const auto& [reason, count] : counts) {
    out.string(reason);
    out.u64(count);
  }
}

Counts readCounts(ByteReader& in, bool& valid) {
  Counts counts;
  const uint32_t size = in.u32();
  valid = valid && size <= kMaxReasons;
  for (uint32_t i = 0; i < size && valid && in.ok(); ++i) {
    const std::string reason = in.string(kMaxNameBytes);
    valid = counts.empty() || counts.rbegin()->first < reason;
    counts.emplace_hint(counts.end(), reason, in.u64());
  }
  return counts;
}

void write(ByteWriter& out, const BuildReport& report) {
  for (const uint64_t value :
       {report.inputTriangles, report.inputVertices, report.viewsBaked, report.viewsKept, report.impostorBytes,
        report.impostorRawBytes, report.geometryBytes, report.textureBytes})
    out.u64(value);
  write(out, report.skipped);
  write(out, report.viewsLeftOut);
  write(out, report.bytesLeftOut);
}

BuildReport readReport(ByteReader& in, bool& valid) {
  BuildReport report;
  for (uint64_t* value : {&report.inputTriangles, &report.inputVertices, &report.viewsBaked, &report.viewsKept,
                          &report.impostorBytes, &report.impostorRawBytes, &report.geometryBytes, &report.textureBytes})
    *value = in.u64();
  report.skipped = readCounts(in, valid);
  report.viewsLeftOut = readCounts(in, valid);
  report.bytesLeftOut = readCounts(in, valid);
  return report;
}

void write(ByteWriter& out, const CellRecord& cell) {
  for (const uint32_t value : {cell.key.level, cell.key.x, cell.key.y, cell.key.z, cell.parent, cell.firstChild,
                               cell.childCount, cell.firstGeometryPage, cell.geometryPageCount, cell.firstViewPage,
                               cell.viewPageCount, cell.firstTexturePage, cell.texturePageCount})
    out.u32(value);
  write(out, cell.content);
  out.u64(cell.triangles);
  out.u64(cell.meshTriangles);
  out.f64(cell.geometricError);
  for (const auto& way : cell.errors.codes)
    for (const uint8_t code : way) out.u8(code);
  out.u16(static_cast<uint16_t>(cell.form.views));
  out.u16(static_cast<uint16_t>(cell.form.imageSize));
}

CellRecord readCell(ByteReader& in) {
  CellRecord cell;
  for (uint32_t* value : {&cell.key.level, &cell.key.x, &cell.key.y, &cell.key.z, &cell.parent, &cell.firstChild,
                          &cell.childCount, &cell.firstGeometryPage, &cell.geometryPageCount, &cell.firstViewPage,
                          &cell.viewPageCount, &cell.firstTexturePage, &cell.texturePageCount})
    *value = in.u32();
  cell.content = readBox(in);
  cell.triangles = in.u64();
  cell.meshTriangles = in.u64();
  cell.geometricError = in.f64();
  for (auto& way : cell.errors.codes)
    for (uint8_t& code : way) code = in.u8();
  cell.form.views = in.u16();
  cell.form.imageSize = in.u16();
  return cell;
}

void write(ByteWriter& out, const PageRecord& page) {
  for (const uint32_t value :
       {static_cast<uint32_t>(page.kind), page.cell, page.group, page.storedBytes, page.decodedBytes, 0u})
    out.u32(value);
  out.u64(page.offsetBytes);
  out.u64(page.checksum);
}

PageRecord readPageRecord(ByteReader& in, bool& valid) {
  PageRecord page;
  page.kind = static_cast<PageKind>(in.u32());
  for (uint32_t* value : {&page.cell, &page.group, &page.storedBytes, &page.decodedBytes}) *value = in.u32();
  valid = valid && in.u32() == 0;
  page.offsetBytes = in.u64();
  page.checksum = in.u64();
  return page;
}

}  // namespace

std::vector<std::byte> encodeDirectory(const Directory& directory) {
  FARCELL_CHECK(directory.sourceName.size() <= kMaxNameBytes);
  FARCELL_CHECK(directory.cells.size() < kNone && directory.pages.size() < kNone);
  ByteWriter out;
  write(out, directory.model);
  out.string(directory.sourceName);
  write(out, directory.report);
  out.u32(static_cast<uint32_t>(directory.cells.size()));
  for (const CellRecord& cell : directory.cells) write(out, cell);
  out.u32(static_cast<uint32_t>(directory.pages.size()));
  for (const PageRecord& page : directory.pages) write(out, page);
  return std::move(out.bytes);
}

Result<Directory> decodeDirectory(std::span<const std::byte> bytes, uint64_t offset, const std::string& path,
                                  DirectoryPlaces& places) {
  ByteReader in(bytes);
  bool valid = true;
  const auto wrong = [&](const char* expected) {
    return corrupt(path, offset + in.position(), expected, in.ok() ? "other values" : "the end of the directory");
  };
  // A count is believed only when its records fit in what is left.
  const auto readRecordCount = [&](uint64_t recordBytes) {
    const uint32_t count = in.u32();
    valid = valid && in.ok() && count <= in.remaining() / recordBytes;
    return valid ? count : 0;
  };
  Directory directory;
  places.model = offset;
  directory.model = readModel(in, valid);
  if (!valid || !in.ok()) return wrong("a model and its settings before this");
  directory.sourceName = in.string(kMaxNameBytes);
  directory.report = readReport(in, valid);
  if (!valid || !in.ok()) return wrong("the source's name and the build's report before this");
  directory.cells.resize(readRecordCount(kCellRecordBytes));
  places.cells = offset + in.position();
  for (CellRecord& cell : directory.cells) cell = readCell(in);
  directory.pages.resize(readRecordCount(kPageRecordBytes));
  places.pages = offset + in.position();
  for (PageRecord& page : directory.pages) page = readPageRecord(in, valid);
  if (!valid || !in.ok()) return wrong("the records of cells and pages before this");
  if (in.remaining() != 0) return wrong("the end of the directory");
  return directory;
}

uint64_t hashSettings(const BuildSettings& settings) {
  ByteWriter out;
  write(out, settings);
  return hashBytes(out.bytes);
}

}  // namespace farcell
