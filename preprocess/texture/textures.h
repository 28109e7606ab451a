// The textures of a mesh, for as many threads as want to look at them, in bounded memory.
//
// 1. open: every image is checked (image_data.h), decoded once (image_rows.h) and goes as a pyramid of tiles
//    (pyramid.h) to a file of the work directory: 16/3 bytes a pixel on disk, some rows in memory. What became of all
//    images goes to another: from then on neither mesh nor images are needed.
// 2. Each thread takes a sampler: it finds tiles through a cache of its own (tile_cache.h) and filters them (filter.h).
//    No lock, no state that an answer could depend on.
//
// An image that is missing, broken or beyond the limits, in whatever format names it, is no error: shapes do not depend
// on it. Its triangles keep the colours that they have without it, and leftOut() says so.
#pragma once

#include <algorithm>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "cache/base/file.h"
#include "cache/base/progress.h"
#include "preprocess/mesh/texture_sampler.h"
#include "preprocess/mesh/texture_source.h"
#include "preprocess/texture/pyramid.h"

namespace farcell {

// One of them in the file of tiles.
struct Pyramid {
  std::vector<PyramidLevel> levels;  // empty: left out
  uint64_t firstTile = 0;            // in the file
  TextureWrap wrapU = TextureWrap::repeat, wrapV = TextureWrap::repeat;
  SurfaceKind surface;
};

class Textures {
 public:
  // Takes them from the work directory where an earlier call left all of them. Fails only where the directory does, or
  // when the user interrupts. Without sources no file is made. The owner of the directory sees to it that all in it
  // comes from the same sources.
  static Result<Textures> open(std::span<const TextureSource> sources, const std::filesystem::path& workDirectory,
                               int threads, Progress& progress);
  // Nothing where not all of `count` textures were left; several processes may call it. Changes nothing.
  static std::optional<Textures> load(const std::filesystem::path& workDirectory, uint64_t count);

  size_t count() const { return pyramids_.size(); }
  // Why each image that was left out was, in the order of the sources.
  const std::vector<Error>& leftOut() const { return leftOut_; }
  // Whether triangles with one of them are seen from their front only.
  bool haveSides() const {
    return std::any_of(pyramids_.begin(), pyramids_.end(), [](const auto& p) { return !p.surface.doubleSided; });
  }
  // Must not outlive the textures.
  std::unique_ptr<TextureSampler> sampler() const;

 private:
  Textures() = default;
  Result<> save(const std::filesystem::path& workDirectory) const;

  std::unique_ptr<ScratchFile> tiles_;  // does not move: samplers hold on to it
  std::vector<Pyramid> pyramids_;
  std::vector<Error> leftOut_;
};

}  // namespace farcell
