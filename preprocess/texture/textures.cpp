#include "preprocess/texture/textures.h"

#include <atomic>
#include <optional>

#include "cache/base/interrupt.h"
#include "cache/base/parallel.h"
#include "preprocess/texture/filter.h"
#include "preprocess/texture/image_rows.h"

namespace farcell {
namespace {

// What became of one source: an image that cannot be used, or a failure that ends the build, or neither.
struct Loaded {
  Pyramid pyramid;
  std::optional<Error> leftOut;
  Result<> result;
};

class Loader {
 public:
  explicit Loader(ScratchFile& tiles) : tiles_(tiles) {}

  Loaded load(const TextureSource& source) {
    Loaded loaded;
    if (loaded.result = checkInterrupt(); !loaded.result) return loaded;
    const Result<> decoded = decode(source, loaded);
    if (!loaded.result || decoded) return loaded;
    loaded.pyramid.levels.clear();
    loaded.leftOut = decoded.error();
    return loaded;
  }

 private:
  // A failure to write goes to loaded.result as well.
  Result<> decode(const TextureSource& source, Loaded& loaded) {
    FARCELL_ASSIGN(const ImageData image, readImageData(source));
    Pyramid& pyramid = loaded.pyramid;
    pyramid = {pyramidLevels(image.width, image.height), 0, source.wrapU, source.wrapV};
    pyramid.firstTile = nextTile_.fetch_add(tileCount(pyramid.levels));
    const PyramidBuilder::Sink write = [&](uint64_t firstTile, std::span<const uint32_t> pixels) {
      loaded.result =
          tiles_.writeAt((pyramid.firstTile + firstTile) * kTilePixels * sizeof(uint32_t), std::as_bytes(pixels));
      return loaded.result;
    };
    PyramidBuilder builder(pyramid.levels, write);
    return decodeRows(image, source.file.string(), [&](std::span<const uint32_t> row) { return builder.addRow(row); });
  }

  ScratchFile& tiles_;
  std::atomic<uint64_t> nextTile_{0};
};

}  // namespace

Result<Textures> Textures::open(std::span<const TextureSource> sources, const std::filesystem::path& scratchDirectory,
                                int threads, Progress& progress) {
  Textures textures;
  if (sources.empty()) return textures;
  FARCELL_ASSIGN(ScratchFile tiles, ScratchFile::create(scratchDirectory));
  textures.tiles_ = std::make_unique<ScratchFile>(std::move(tiles));
  Loader loader(*textures.tiles_);
  std::vector<Loaded> loaded(sources.size());
  progress.begin("textures", sources.size(), "images");
  parallelFor(sources.size(), threads, [&](size_t i, int) {
    loaded[i] = loader.load(sources[i]);
    progress.advance();
  });
  for (Loaded& one : loaded) {
    FARCELL_TRY(one.result);
    textures.pyramids_.push_back(std::move(one.pyramid));
    if (one.leftOut) textures.leftOut_.push_back(std::move(*one.leftOut));
  }
  return textures;
}

std::unique_ptr<TextureSampler> Textures::sampler() const {
  return std::make_unique<PyramidSampler>(pyramids_, tiles_.get());
}

}  // namespace farcell
