// A pack file: written in one pass, opened by three reads (header, footer, directory). See FORMAT.md.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "cache/base/file.h"
#include "cache/base/result.h"
#include "cache/pack/directory.h"
#include "cache/pack/pages.h"

namespace farcell {

inline constexpr uint32_t kPackVersion = 0;

// Appends pages, then the directory; the file appears under its name at `finish`, whole and synced.
class PackWriter {
 public:
  static Result<PackWriter> create(const std::filesystem::path& path);
  PackWriter(PackWriter&&) noexcept = default;

  // Returns the new page's index. Pages of a cell of one kind must be added one after the other, by rising group.
  // REQUIRES: `stored` is what the encoder of that kind returned, `decodedBytes` the page's decodedSizeBytes.
  Result<uint32_t> add(PageKind kind, uint32_t cell, uint32_t group, uint32_t decodedBytes,
                       std::span<const std::byte> stored);
  // `directory.pages` and the report's bytes of views, geometry and textures are ignored and filled from what was
  // added. Returns the size of the file. REQUIRES: a directory that PackFile::open would accept (CHECK): cells by level
  // and Morton code, children's content inside their parent's, each page named by its cell.
  Result<uint64_t> finish(Directory directory);

 private:
  PackWriter(OutputFile file, std::string path) : file_(std::move(file)), path_(std::move(path)) {}
  OutputFile file_;
  std::string path_;
  std::vector<PageRecord> pages_;
};

// An opened pack. Thread-safe: reads are positional and the directory never changes.
class PackFile {
 public:
  // Checks magic, version, every offset, size, index and checksum of footer and directory; the tree is a tree,
  // children lie inside parents, pages do not overlap and fill the file.
  static Result<PackFile> open(const std::filesystem::path& path);

  const std::string& path() const { return file_.path(); }
  uint64_t sizeBytes() const { return file_.sizeBytes(); }
  const Directory& directory() const { return directory_; }

  // A page as it is stored; its checksum is right.
  Result<std::vector<std::byte>> readStored(uint32_t page) const;
  // Reads, checks and decodes. REQUIRES: the page is of that kind. The page agrees with its record, its cell (number of
  // triangles, positions inside the content, an atlas or none, group of the views) and the model (colours, normals), or
  // the result is corrupt.
  Result<GeometryPage> readGeometry(uint32_t page) const;
  Result<ViewPage> readViews(uint32_t page) const;
  // What a decoder of it may believe.
  ViewLimits viewLimits(uint32_t page) const;
  Result<TexturePage> readTexture(uint32_t page) const;
  // The pages of the atlas of a part of a leaf's mesh, by group; none where it has no textures.
  std::span<const PageRecord> atlasPages(uint32_t cell, uint32_t part) const;
  // All levels of that atlas, from several pages. REQUIRES: it has pages.
  Result<TexturePage> readAtlas(uint32_t cell, uint32_t part) const;

  // Every byte of the file: header, footer and directory once more, all checksums, all pages decoded,
  // cells and pages consistent with content. Returns one Error per finding, at most maxFindings. `progress` may be
  // empty. An interrupt (base/interrupt.h) ends it with an Error of kind cancelled.
  std::vector<Error> verify(size_t maxFindings, const std::function<void(uint64_t pagesDone)>& progress) const;

 private:
  PackFile(InputFile file, Directory directory) : file_(std::move(file)), directory_(std::move(directory)) {}
  InputFile file_;
  Directory directory_;
};

}  // namespace farcell
