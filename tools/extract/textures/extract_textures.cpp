#include "tools/extract/textures/extract_textures.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <system_error>

#include "cache/base/interrupt.h"
#include "tools/extract/image/image_file.h"

namespace farcell {
namespace {

using Json = nlohmann::ordered_json;

// Upright, and not premultiplied.
Picture pictureOf(const TexturePage& atlas, uint32_t level) {
  const uint32_t width = atlas.width >> level, height = atlas.height >> level, channels = atlas.channels;
  const std::vector<uint8_t>& texels = atlas.levels[level];
  Picture picture{static_cast<int>(width), static_cast<int>(height), static_cast<int>(channels), {}};
  picture.pixels.reserve(texels.size());
  for (uint32_t row = 0; row < height; ++row)
    for (uint32_t x = 0; x < width; ++x) {
      const uint8_t* texel = texels.data() + size_t{channels} * (size_t{height - 1 - row} * width + x);
      const uint8_t alpha = channels == 4 ? texel[3] : uint8_t{255};
      for (uint32_t channel = 0; channel < 3; ++channel) picture.pixels.push_back(withoutAlpha(texel[channel], alpha));
      if (channels == 4) picture.pixels.push_back(alpha);
    }
  return picture;
}

// An atlas that a leaf shares is named after the leaf whose pages it is in.
std::filesystem::path pathOf(const TextureExtraction& settings, uint32_t owner, uint32_t part) {
  return settings.directory / fmt::format("cell-{}-part-{}-texture.{}", owner, part, settings.format);
}

}  // namespace

std::vector<uint32_t> cellsWithTextures(const Directory& directory) {
  std::vector<uint32_t> cells;
  for (uint32_t i = 0; i < directory.cells.size(); ++i)
    if (directory.cells[i].firstTexturePage != kNone) cells.push_back(i);
  return cells;
}

Result<Json> extractTextures(const PackFile& pack, const TextureExtraction& settings) {
  const Directory& directory = pack.directory();
  uint64_t parts = 0;
  for (const uint32_t cell : settings.cells) parts += directory.cells[cell].geometryPageCount;
  if (parts > kMaxExtractedTextures)
    return fail(ErrorKind::exhausted, "{} pictures: at most {} are written at once; choose cells", parts,
                kMaxExtractedTextures);
  std::error_code code;
  std::filesystem::create_directories(settings.directory, code);
  if (code) return fail(ErrorKind::io, "{}: {}", settings.directory.string(), code.message());
  Json files = Json::array();
  std::set<std::filesystem::path> done;
  for (const uint32_t cell : settings.cells) {
    const CellRecord& record = directory.cells[cell];
    if (record.firstTexturePage == kNone) continue;
    for (uint32_t part = 0; part < record.geometryPageCount; ++part) {
      FARCELL_TRY(checkInterrupt());
      const std::span<const PageRecord> pages = pack.atlasPages(cell, part);
      if (pages.empty()) continue;
      FARCELL_ASSIGN(const TexturePage atlas, pack.readAtlas(cell, part));
      const uint32_t level = std::min(settings.level, atlas.levelCount - 1);
      const std::filesystem::path path = pathOf(settings, pages.front().cell, part);
      if (done.insert(path).second) FARCELL_TRY(writeImageFile(path, pictureOf(atlas, level)));
      const CellKey& key = record.key;
      files.push_back({{"file", path.string()},
                       {"cell", cell},
                       {"key", fmt::format("{}/{}/{}/{}", key.level, key.x, key.y, key.z)},
                       {"part", part},
                       {"level", level},
                       {"width", atlas.width >> level},
                       {"height", atlas.height >> level}});
    }
  }
  return Json{{"written", files}};
}

}  // namespace farcell
