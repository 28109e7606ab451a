#include "cache/pack/pack_file.h"

#include <algorithm>

#include "cache/base/check.h"
#include "cache/base/hash.h"
#include "cache/base/interrupt.h"
#include "cache/pack/directory_check.h"
#include "cache/pack/directory_codec.h"
#include "cache/pack/layout.h"

namespace farcell {
namespace {

Result<std::vector<std::byte>> readBytes(const InputFile& file, uint64_t offset, uint64_t size) {
  std::vector<std::byte> bytes(size);
  FARCELL_TRY(file.readAt(offset, bytes));
  return bytes;
}

// Header, footer and directory, each checked before the next is looked for.
Result<Directory> readDirectory(const InputFile& file) {
  if (file.sizeBytes() < kHeaderBytes + kFooterBytes)
    return corrupt(file.path(), 0, fmt::format("a pack of at least {} bytes", kHeaderBytes + kFooterBytes),
                   fmt::format("{}", file.sizeBytes()));
  FARCELL_ASSIGN(const auto header, readBytes(file, 0, kHeaderBytes));
  FARCELL_TRY(checkHeader(header, file.path()));
  FARCELL_ASSIGN(const auto end, readBytes(file, file.sizeBytes() - kFooterBytes, kFooterBytes));
  FARCELL_ASSIGN(const Footer footer, decodeFooter(end, file.sizeBytes(), file.path()));
  FARCELL_ASSIGN(const auto bytes, readBytes(file, footer.directoryOffset, footer.directoryBytes));
  if (hashBytes(bytes) != footer.directoryChecksum)
    return corrupt(file.path(), footer.directoryOffset,
                   fmt::format("a directory of checksum {:016x}", footer.directoryChecksum),
                   fmt::format("{:016x}", hashBytes(bytes)));
  DirectoryPlaces places;
  FARCELL_ASSIGN(Directory directory, decodeDirectory(bytes, footer.directoryOffset, file.path(), places));
  FARCELL_TRY(checkDirectory(directory, places, footer.directoryOffset, file.path()));
  const uint64_t settingsHash = hashSettings(directory.model.settings);
  if (settingsHash != footer.settingsHash)
    return corrupt(file.path(), places.model, fmt::format("settings of hash {:016x}", footer.settingsHash),
                   fmt::format("{:016x}", settingsHash));
  directory.sourceHash = footer.sourceHash;
  return directory;
}

// A page's own message gets the file and the page in front.
tl::unexpected<Error> inPage(const PackFile& pack, uint32_t page, const std::string& message) {
  return fail(ErrorKind::corrupt, "{}: offset {}: page {}: {}", pack.path(), pack.directory().pages[page].offsetBytes,
              page, message);
}

Result<> checkGeometry(const GeometryPage& page, uint32_t part, bool hasAtlas, const CellRecord& cell,
                       const Model& model) {
  const auto wrong = [](const std::string& expected, const std::string& found) {
    return fail(ErrorKind::corrupt, "expected {}, found {}", expected, found);
  };
  const uint64_t triangles = partTriangles(cell.meshTriangles, part);
  if (page.indices.size() / 3 != triangles)
    return wrong(fmt::format("{} triangles", triangles), fmt::format("{}", page.indices.size() / 3));
  if (!page.positions.empty() && (page.colours.empty() == model.hasColours || page.normals.empty() == model.hasNormals))
    return wrong(fmt::format("colours: {}, normals: {}", model.hasColours, model.hasNormals),
                 fmt::format("{}, {}", !page.colours.empty(), !page.normals.empty()));
  if (page.coordinates.empty() == hasAtlas)
    return wrong(fmt::format("texture coordinates: {}", hasAtlas), fmt::format("{}", !page.coordinates.empty()));
  const bool mayShow = cell.childCount > 0 && !model.hasNormals && model.settings.lighting == Lighting::baked;
  if (!page.shown.empty() && !mayShow)
    return wrong("triangles that show their vertices' colours", "some that say what they show");
  const uint32_t mayBeSet = 0xffffff | (model.hasSides && cell.childCount == 0 ? kSeenFromFront : 0);
  for (const uint32_t colour : page.colours)
    if ((colour & ~mayBeSet) != 0) return wrong("colours of 3 bytes", fmt::format("{:#010x}", colour));
  const GridPoint corner = cellBox(model.grid, cell.key).min;
  // Simplified meshes stay in the cube only: parts of them may stand for others beside them.
  const GridBox room = cell.childCount == 0 ? cell.content : cellBox(model.grid, cell.key);
  GridBox box = room;
  for (const glm::uvec3& position : page.positions) box.include(corner + GridPoint(position));
  if (box != room) return wrong("positions inside the cell's content", "others");
  return {};
}

Result<> checkViews(const ViewPage& page, const PageRecord& record, const Model& model, const Viewpoints& viewpoints) {
  for (const ViewImage& view : page.views) {
    const auto group = static_cast<uint32_t>(viewpoints.group(static_cast<int>(view.view)));
    if (group != record.group)
      return fail(ErrorKind::corrupt, "expected views of group {}, found view {} of group {}", record.group, view.view,
                  group);
    const bool relightable = model.settings.lighting == Lighting::relightable;
    if (view.width > 0 && view.normal.empty() == relightable)
      return fail(ErrorKind::corrupt, "expected views with normals: {}, found {}", relightable, !view.normal.empty());
  }
  return {};
}

// The coarsest levels in the group 0, one level in each other.
Result<> checkTexture(const TexturePage& page, const PageRecord& record) {
  const bool coarse = record.group % kAtlasGroups == 0;
  const uint32_t first = firstCoarseLevel(page);
  if (coarse ? page.firstLevel == first && page.levels.size() == page.levelCount - first
             : page.levels.size() == 1 && page.firstLevel == first - record.group % kAtlasGroups)
    return {};
  return fail(ErrorKind::corrupt, "expected the levels of group {} of {} with {} coarse ones, found {} from {}",
              record.group % kAtlasGroups, page.levelCount, page.levelCount - first, page.levels.size(),
              page.firstLevel);
}

struct PartOrder {
  bool operator()(const PageRecord& page, uint32_t part) const { return page.group / kAtlasGroups < part; }
  bool operator()(uint32_t part, const PageRecord& page) const { return part < page.group / kAtlasGroups; }
};

Result<> checkDecodedSize(uint32_t expectedBytes, uint32_t foundBytes) {
  if (foundBytes == expectedBytes) return {};
  return fail(ErrorKind::corrupt, "expected {} decoded bytes, found {}", expectedBytes, foundBytes);
}

}  // namespace

Result<PackFile> PackFile::open(const std::filesystem::path& path) {
  FARCELL_ASSIGN(InputFile file, InputFile::open(path));
  FARCELL_ASSIGN(Directory directory, readDirectory(file));
  return PackFile(std::move(file), std::move(directory));
}

Result<std::vector<std::byte>> PackFile::readStored(uint32_t page) const {
  FARCELL_CHECK(page < directory_.pages.size());
  const PageRecord& record = directory_.pages[page];
  FARCELL_ASSIGN(std::vector<std::byte> bytes, readBytes(file_, record.offsetBytes, record.storedBytes));
  const uint64_t checksum = hashBytes(bytes);
  if (checksum != record.checksum)
    return inPage(*this, page, fmt::format("expected checksum {:016x}, found {:016x}", record.checksum, checksum));
  return bytes;
}

Result<GeometryPage> PackFile::readGeometry(uint32_t page) const {
  FARCELL_ASSIGN(const std::vector<std::byte> bytes, readStored(page));
  const PageRecord& record = directory_.pages[page];
  FARCELL_CHECK(record.kind == PageKind::geometry);
  const CellRecord& cell = directory_.cells[record.cell];
  const uint32_t maxCoordinate = 1u << (directory_.model.grid.bits - static_cast<int>(cell.key.level));
  Result<GeometryPage> decoded = decodeGeometryPage(bytes, {maxCoordinate, record.decodedBytes});
  if (!decoded) return inPage(*this, page, decoded.error().message);
  const Result<> checked = checkDecodedSize(record.decodedBytes, decodedSizeBytes(*decoded)).and_then([&] {
    const bool hasAtlas = !atlasPages(record.cell, record.group).empty();
    return checkGeometry(*decoded, record.group, hasAtlas, cell, directory_.model);
  });
  if (!checked) return inPage(*this, page, checked.error().message);
  return decoded;
}

ViewLimits PackFile::viewLimits(uint32_t page) const {
  const PageRecord& record = directory_.pages[page];
  return viewLimitsOf(directory_.cells[record.cell].form, record.decodedBytes);
}

Result<ViewPage> PackFile::readViews(uint32_t page) const {
  FARCELL_ASSIGN(const std::vector<std::byte> bytes, readStored(page));
  const PageRecord& record = directory_.pages[page];
  FARCELL_CHECK(record.kind == PageKind::views);
  Result<ViewPage> decoded = decodeViewPage(bytes, viewLimits(page));
  if (!decoded) return inPage(*this, page, decoded.error().message);
  const Result<> checked = checkDecodedSize(record.decodedBytes, decodedSizeBytes(*decoded)).and_then([&] {
    return checkViews(*decoded, record, directory_.model, Viewpoints::of(directory_.cells[record.cell].form.views));
  });
  if (!checked) return inPage(*this, page, checked.error().message);
  return decoded;
}

std::span<const PageRecord> PackFile::atlasPages(uint32_t cell, uint32_t part) const {
  const CellRecord& record = directory_.cells[cell];
  if (record.texturePageCount == 0) return {};
  const auto all = std::span(directory_.pages).subspan(record.firstTexturePage, record.texturePageCount);
  const auto [first, last] = std::equal_range(all.begin(), all.end(), part, PartOrder{});
  return all.subspan(static_cast<size_t>(first - all.begin()), static_cast<size_t>(last - first));
}

Result<TexturePage> PackFile::readTexture(uint32_t page) const {
  FARCELL_ASSIGN(const std::vector<std::byte> bytes, readStored(page));
  const PageRecord& record = directory_.pages[page];
  FARCELL_CHECK(record.kind == PageKind::texture);
  Result<TexturePage> decoded = decodeTexturePage(bytes, {record.decodedBytes});
  if (!decoded) return inPage(*this, page, decoded.error().message);
  const Result<> checked = checkDecodedSize(record.decodedBytes, decodedSizeBytes(*decoded)).and_then([&] {
    return checkTexture(*decoded, record);
  });
  if (!checked) return inPage(*this, page, checked.error().message);
  return decoded;
}

Result<TexturePage> PackFile::readAtlas(uint32_t cell, uint32_t part) const {
  const std::span<const PageRecord> records = atlasPages(cell, part);
  FARCELL_CHECK(!records.empty());
  const auto first = static_cast<uint32_t>(&records[0] - directory_.pages.data());
  std::vector<TexturePage> pages;
  for (uint32_t i = 0; i < records.size(); ++i) {
    FARCELL_ASSIGN(TexturePage page, readTexture(first + i));
    pages.push_back(std::move(page));
  }
  Result<TexturePage> atlas = atlasOfPages(pages);
  if (!atlas) return inPage(*this, first, atlas.error().message);
  return atlas;
}

std::vector<Error> PackFile::verify(size_t maxFindings, const std::function<void(uint64_t)>& progress) const {
  std::vector<Error> findings;
  const auto note = [&](const auto& result) {
    if (!result && findings.size() < maxFindings) findings.push_back(result.error());
  };
  note(readDirectory(file_));
  for (uint32_t page = 0; page < directory_.pages.size() && findings.size() < maxFindings; ++page) {
    const PageRecord& record = directory_.pages[page];
    if (record.kind == PageKind::geometry)
      note(readGeometry(page));
    else if (record.kind == PageKind::views)
      note(readViews(page));
    else if (record.group % kAtlasGroups == 0)
      note(readAtlas(record.cell, record.group / kAtlasGroups));
    if (progress) progress(page + 1);
    if (const Result<> going = checkInterrupt(); !going) {
      findings.push_back(going.error());
      break;
    }
  }
  return findings;
}

}  // namespace farcell
