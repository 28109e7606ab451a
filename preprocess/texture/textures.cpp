#include "preprocess/texture/textures.h"

#include <algorithm>
#include <atomic>
#include <optional>

#include "cache/base/interrupt.h"
#include "cache/base/parallel.h"
#include "cache/base/sealed_file.h"
#include "preprocess/texture/filter.h"
#include "preprocess/texture/image_rows.h"

namespace farcell {
namespace {

constexpr uint64_t kMagic = 0x32727574'78657466;  // "ftextur2"
constexpr uint64_t kTileBytes = kTilePixels * sizeof(uint32_t);

std::filesystem::path tilesIn(const std::filesystem::path& directory) { return directory / "textures.tiles"; }
std::filesystem::path indexIn(const std::filesystem::path& directory) { return directory / "textures"; }

void put(SealedWriter& writer, const Pyramid& pyramid) {
  writer.put(uint64_t{pyramid.levels.size()});
  for (const PyramidLevel& level : pyramid.levels) writer.put(level);
  writer.put(pyramid.firstTile);
  writer.put(pyramid.wrapU);
  writer.put(pyramid.wrapV);
  writer.put(pyramid.surface.hasImage);
  writer.put(pyramid.surface.doubleSided);
  writer.put(pyramid.surface.alpha);
  writer.put(pyramid.surface.cutoff);
}

bool get(SealedReader& reader, Pyramid& pyramid) {
  uint64_t levels = 0;
  if (!reader.get(levels)) return false;
  for (PyramidLevel level; levels > 0; --levels) {
    if (!reader.get(level)) return false;
    pyramid.levels.push_back(level);
  }
  SurfaceKind& surface = pyramid.surface;
  return reader.get(pyramid.firstTile) && reader.get(pyramid.wrapU) && reader.get(pyramid.wrapV) &&
         reader.get(surface.hasImage) && reader.get(surface.doubleSided) && reader.get(surface.alpha) &&
         reader.get(surface.cutoff);
}

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
    loaded.pyramid.surface.alpha = AlphaMode::opaque;
    loaded.leftOut = decoded.error();
    return loaded;
  }

 private:
  // A failure to write goes to loaded.result as well.
  Result<> decode(const TextureSource& source, Loaded& loaded) {
    Pyramid& pyramid = loaded.pyramid;
    pyramid = {{}, 0, source.wrapU, source.wrapV, source.surface};
    const PyramidBuilder::Sink write = [&](uint64_t firstTile, std::span<const uint32_t> pixels) {
      loaded.result = tiles_.writeAt((pyramid.firstTile + firstTile) * kTileBytes, std::as_bytes(pixels));
      return loaded.result;
    };
    std::optional<PyramidBuilder> builder;
    return readTextureRows(source, [&](int width, int height) -> RowSink {
      pyramid.levels = pyramidLevels(width, height);
      pyramid.firstTile = nextTile_.fetch_add(tileCount(pyramid.levels));
      builder.emplace(pyramid.levels, pyramid.surface, write);
      return [&](std::span<const uint32_t> row) { return builder->addRow(row); };
    });
  }

  ScratchFile& tiles_;
  std::atomic<uint64_t> nextTile_{0};
};

}  // namespace

Result<Textures> Textures::open(std::span<const TextureSource> sources, const std::filesystem::path& workDirectory,
                                int threads, Progress& progress) {
  if (std::optional<Textures> left = load(workDirectory, sources.size())) return *std::move(left);
  Textures textures;
  FARCELL_ASSIGN(ScratchFile tiles, ScratchFile::open(tilesIn(workDirectory)));
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
  FARCELL_TRY(textures.tiles_->sync());
  FARCELL_TRY(textures.save(workDirectory));
  return textures;
}

Result<> Textures::save(const std::filesystem::path& workDirectory) const {
  SealedWriter writer;
  writer.put(kMagic);
  writer.put(count());
  for (const Pyramid& pyramid : pyramids_) put(writer, pyramid);
  writer.put(leftOut_.size());
  for (const Error& error : leftOut_) {
    writer.put(error.kind);
    writer.put(error.message);
  }
  return writer.commit(indexIn(workDirectory));
}

std::optional<Textures> Textures::load(const std::filesystem::path& workDirectory, uint64_t count) {
  Textures textures;
  if (count == 0) return textures;
  std::optional<SealedReader> reader = SealedReader::open(indexIn(workDirectory));
  uint64_t magic = 0, images = 0, errors = 0, tiles = 0;
  if (!reader || !reader->get(magic) || magic != kMagic || !reader->get(images) || images != count) return std::nullopt;
  for (uint64_t i = 0; i < images; ++i) {
    Pyramid pyramid;
    if (!get(*reader, pyramid)) return std::nullopt;
    if (!pyramid.levels.empty()) tiles = std::max(tiles, pyramid.firstTile + tileCount(pyramid.levels));
    textures.pyramids_.push_back(std::move(pyramid));
  }
  if (!reader->get(errors)) return std::nullopt;
  for (; errors > 0; --errors) {
    Error error;
    if (!reader->get(error.kind) || !reader->get(error.message)) return std::nullopt;
    textures.leftOut_.push_back(std::move(error));
  }
  std::error_code code;
  const uint64_t bytes = std::filesystem::file_size(tilesIn(workDirectory), code);
  if (code || bytes < tiles * kTileBytes) return std::nullopt;
  Result<ScratchFile> file = ScratchFile::open(tilesIn(workDirectory));
  if (!file) return std::nullopt;
  textures.tiles_ = std::make_unique<ScratchFile>(*std::move(file));
  return textures;
}

std::unique_ptr<TextureSampler> Textures::sampler() const {
  return std::make_unique<PyramidSampler>(pyramids_, tiles_.get());
}

}  // namespace farcell
