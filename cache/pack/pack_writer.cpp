#include "cache/base/check.h"
#include "cache/base/hash.h"
#include "cache/pack/directory_check.h"
#include "cache/pack/directory_codec.h"
#include "cache/pack/layout.h"
#include "cache/pack/pack_file.h"

namespace farcell {
namespace {

// A pack that its own reader would refuse is never written.
void checkReadable(std::span<const std::byte> bytes, uint64_t offset, const std::string& path) {
  DirectoryPlaces places;
  const Result<Directory> decoded = decodeDirectory(bytes, offset, path, places);
  if (!decoded)
    checkFailed(__FILE_NAME__, __LINE__, "the directory can be read back", " (" + decoded.error().message + ")");
  const Result<> checked = checkDirectory(*decoded, places, offset, path);
  if (!checked) checkFailed(__FILE_NAME__, __LINE__, "the directory is valid", " (" + checked.error().message + ")");
}

}  // namespace

Result<PackWriter> PackWriter::create(const std::filesystem::path& path) {
  FARCELL_ASSIGN(OutputFile file, OutputFile::create(path));
  PackWriter writer(std::move(file), path.string());
  FARCELL_TRY(writer.file_.append(encodeHeader()));
  return writer;
}

Result<uint32_t> PackWriter::add(PageKind kind, uint32_t cell, uint32_t group, uint32_t decodedBytes,
                                 std::span<const std::byte> stored) {
  FARCELL_CHECK(!stored.empty() && stored.size() <= UINT32_MAX);
  PageRecord page{kind, cell, group, file_.sizeBytes(), static_cast<uint32_t>(stored.size()), decodedBytes, 0};
  page.checksum = hashBytes(stored);
  FARCELL_TRY(file_.append(stored));
  pages_.push_back(page);
  return static_cast<uint32_t>(pages_.size() - 1);
}

Result<uint64_t> PackWriter::finish(Directory directory) {
  directory.pages = std::move(pages_);
  const PageBytes stored = pageBytes(directory.pages);
  directory.report.impostorBytes = stored.views;
  directory.report.geometryBytes = stored.geometry;
  directory.report.textureBytes = stored.textures;
  const std::vector<std::byte> bytes = encodeDirectory(directory);
  const uint64_t offset = file_.sizeBytes();
  checkReadable(bytes, offset, path_);
  FARCELL_TRY(file_.append(bytes));
  FARCELL_TRY(file_.append(encodeFooter({.directoryOffset = offset,
                                         .directoryBytes = bytes.size(),
                                         .directoryChecksum = hashBytes(bytes),
                                         .settingsHash = hashSettings(directory.model.settings),
                                         .sourceHash = directory.sourceHash,
                                         .fileBytes = offset + bytes.size() + kFooterBytes})));
  FARCELL_TRY(file_.commit());
  return file_.sizeBytes();
}

}  // namespace farcell
