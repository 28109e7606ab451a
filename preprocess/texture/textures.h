// The textures of a mesh, for as many threads as want to look at them, in bounded memory.
//
// 1. open: every image is checked (image_data.h), decoded once (image_rows.h) and goes as a pyramid of tiles
//    (pyramid.h) to scratch: 16/3 bytes a pixel on disk, some rows in memory.
// 2. Each thread takes a sampler: it finds tiles through a cache of its own (tile_cache.h) and filters them (filter.h).
//    No lock, no state that an answer could depend on.
//
// An image that is missing, broken or beyond the limits, in whatever format names it, is no error: shapes do not depend
// on it. Its triangles keep the colours that they have without it, and leftOut() says so.
#pragma once

#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "cache/base/file.h"
#include "cache/base/progress.h"
#include "preprocess/mesh/texture_sampler.h"
#include "preprocess/mesh/texture_source.h"
#include "preprocess/texture/pyramid.h"

namespace farcell {

// One of them in scratch.
struct Pyramid {
  std::vector<PyramidLevel> levels;  // empty: left out
  uint64_t firstTile = 0;            // in scratch
  TextureWrap wrapU = TextureWrap::repeat, wrapV = TextureWrap::repeat;
};

class Textures {
 public:
  // Fails only where scratch does, or when the user interrupts. Without sources no file is made.
  static Result<Textures> open(std::span<const TextureSource> sources, const std::filesystem::path& scratchDirectory,
                               int threads, Progress& progress);

  size_t count() const { return pyramids_.size(); }
  // Why each image that was left out was, in the order of the sources.
  const std::vector<Error>& leftOut() const { return leftOut_; }
  // Must not outlive the textures.
  std::unique_ptr<TextureSampler> sampler() const;

 private:
  Textures() = default;

  std::unique_ptr<ScratchFile> tiles_;  // does not move: samplers hold on to it
  std::vector<Pyramid> pyramids_;
  std::vector<Error> leftOut_;
};

}  // namespace farcell
