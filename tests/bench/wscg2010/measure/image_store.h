// The images of a camera path on disk, as the paper kept them and deflated: one file each, image after image.
#pragma once

#include <filesystem>
#include <map>
#include <span>
#include <utility>
#include <vector>

#include "cache/base/file.h"
#include "tests/bench/wscg2010/scene/impostors.h"

namespace farcell::wscg {

class ImageStore {
 public:
  // Writes every image of the billboards once, in order of cell and view, and opens the file.
  static Result<ImageStore> write(const std::filesystem::path& path, std::span<const Billboard> billboards,
                                  bool deflated);

  // Stored bytes of a billboard's image, into `bytes`; returns how many.
  Result<size_t> read(const Billboard& billboard, std::vector<std::byte>& bytes) const;
  // What was read, as RGBA; `texels` is resized.
  Result<> decode(const Billboard& billboard, std::span<const std::byte> bytes, std::vector<uint8_t>& texels) const;

  bool deflated() const { return deflated_; }
  uint64_t sizeBytes() const { return file_.sizeBytes(); }
  // Asks the operating system to forget what it has in memory of the file; returns the share it has afterwards.
  Result<double> dropFromMemory() const;

 private:
  struct Place {
    uint64_t offset = 0;
    size_t bytes = 0;
  };
  using Key = std::pair<uint32_t, int>;  // cell, view
  ImageStore(InputFile file, std::map<Key, Place> places, bool deflated);

  InputFile file_;
  std::map<Key, Place> places_;
  bool deflated_;
};

}  // namespace farcell::wscg
