// Pages and packs for the tests of cache/pack: random ones, and a small pack that uses every feature.
#pragma once

#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "cache/base/check.h"
#include "cache/base/hash.h"
#include "cache/pack/directory_codec.h"
#include "cache/pack/layout.h"
#include "cache/pack/pack_file.h"

namespace farcell::samples {

using Bytes = std::vector<std::byte>;

inline uint32_t below(std::mt19937& random, uint32_t bound) { return static_cast<uint32_t>(random() % bound); }

// Neighbouring triangles, repeated coordinates and noise in one: what every branch of the coder meets.
inline GeometryPage randomGeometry(std::mt19937& random, uint32_t vertices, uint32_t triangles, uint32_t maxCoordinate,
                                   bool colours, bool normals, bool coordinates = false, bool shown = false) {
  GeometryPage page;
  for (uint32_t i = 0; i < vertices; ++i) {
    glm::uvec3 position;
    for (int axis = 0; axis < 3; ++axis)
      position[axis] = i > 0 && random() % 2 == 0 ? page.positions[below(random, i)][axis]
                                                  : static_cast<uint32_t>(random() % (uint64_t{maxCoordinate} + 1));
    page.positions.push_back(position);
    if (colours) page.colours.push_back(random() % 3 == 0 ? 0x00ffffffu : static_cast<uint32_t>(random()));
    if (normals) page.normals.push_back(static_cast<uint32_t>(random()));
    if (coordinates) page.coordinates.push_back(random() % 3 == 0 ? 0x00ff00ffu + i : static_cast<uint32_t>(random()));
  }
  for (uint32_t i = 0; i < triangles; ++i) {
    const size_t size = page.indices.size();
    const bool shares = size > 0 && random() % 3 != 0;
    const uint32_t a = shares ? page.indices[size - 1] : below(random, vertices);
    const uint32_t b = shares ? page.indices[size - 2] : below(random, vertices);
    page.indices.insert(page.indices.end(), {a, b, below(random, vertices)});
    if (shown) page.shown.push_back(random() % 3 == 0 ? 0x00808080u : static_cast<uint32_t>(random()) & 0xffffff);
  }
  return page;
}

// kind 0: noise; 1: a smooth gradient; 2: flat areas with a few colours.
inline ViewImage randomView(std::mt19937& random, uint32_t view, uint32_t imageSize, bool normals, int kind) {
  ViewImage image;
  image.view = view;
  image.width = 1 + below(random, imageSize);
  image.height = 1 + below(random, imageSize);
  image.x0 = below(random, imageSize - image.width + 1);
  image.y0 = below(random, imageSize - image.height + 1);
  image.depthMin = -1.25f;
  image.depthMax = image.depthMin + static_cast<float>(below(random, 1000)) / 500.0f;
  for (uint32_t y = 0; y < image.height; ++y) {
    for (uint32_t x = 0; x < image.width; ++x) {
      for (uint32_t channel = 0; channel < (normals ? 8u : 5u); ++channel) {
        uint32_t value = static_cast<uint32_t>(random());
        if (kind == 1) value = x * (channel + 1) + y * 2 + value % 2;
        if (kind == 2) value = (x / 5 + y / 7) % 3 * 80;
        auto& plane = channel < 4 ? image.rgba : channel == 4 ? image.depth : image.normal;
        plane.push_back(static_cast<uint8_t>(value));
      }
    }
  }
  return image;
}

// An atlas with all its levels, of two groups when it is large.
inline TexturePage randomAtlas(std::mt19937& random, uint32_t width, uint32_t height, uint32_t channels,
                               uint32_t levels) {
  TexturePage atlas{width, height, channels, levels, 0, {}};
  const bool smooth = random() % 2 == 0;
  for (uint32_t level = 0; level < levels; ++level) {
    auto& texels = atlas.levels.emplace_back();
    for (uint32_t i = 0; i < (width >> level) * (height >> level) * channels; ++i)
      texels.push_back(static_cast<uint8_t>(smooth ? i / 7 + i % channels * 40 : random()));
  }
  return atlas;
}

// A file in memory where there is such a place (tests rewrite it 100,000 times), removed with this.
class TemporaryFile {
 public:
  explicit TemporaryFile(const std::string& name) : path_(directory() / fmt::format("{}-{}", ::getpid(), name)) {}
  ~TemporaryFile() { std::filesystem::remove(path_); }
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;
  const std::filesystem::path& path() const { return path_; }

 private:
  static std::filesystem::path directory() {
    const std::filesystem::path memory = "/dev/shm";
    return std::filesystem::is_directory(memory) ? memory : std::filesystem::temp_directory_path();
  }
  std::filesystem::path path_;
};

inline Bytes readAll(const std::filesystem::path& path) {
  const Result<InputFile> file = InputFile::open(path);
  FARCELL_CHECK(file.has_value());
  Bytes bytes(file->sizeBytes());
  FARCELL_CHECK(file->readAt(0, bytes).has_value());
  return bytes;
}

// Without the sync of OutputFile, which would take most of the tests' time.
inline void writeAll(const std::filesystem::path& path, std::span<const std::byte> bytes) {
  std::ofstream out(path, std::ios::binary | std::ios::trunc);
  out.write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
  FARCELL_CHECK(out.flush().good());
}

// A triangle in the lowest corner of the cube, spanning `size` steps.
inline GeometryPage cornerTriangle(uint32_t size) {
  GeometryPage page;
  page.positions = {{0, 0, 0}, {size, 0, 0}, {0, size, 0}};
  page.colours = {0x00112233, 0x00445566, 0x00778899};
  page.normals = {0x7fff, 0x7fff0000, 0x80018001};
  page.coordinates = {0x00001000, 0x80007fff, 0xffffffff};
  page.indices = {0, 1, 2};
  return page;
}

// What fullPack() writes: a root with two leaves; colours, normals, baked normals; skipped triangles and views left
// out by reason; views of the root in two groups (one of them empty images) and of the second leaf in one.
struct FullPack {
  Directory directory;
  std::vector<GeometryPage> geometry;  // of pages 2 and 3
  std::vector<ViewPage> views;         // of pages 0, 1 and 4
  TexturePage atlas;                   // in pages 5 and 6, of both leaves
};

inline Directory fullDirectory() {
  Directory directory;
  Model& model = directory.model;
  model.grid = {glm::dvec3(-5, 1e6, 0.125), 80, 20};
  model.bounds = {GridPoint(0), GridPoint(1 << 19, 1 << 10, 1000)};
  model.settings = {.form = {42, 16},
                    .samples = 4,
                    .leafTriangles = 100,
                    .maxLevel = 3,
                    .fixedLevel = 1,
                    .up = UpAxis::y,
                    .metresPerUnit = 0.0254,
                    .lighting = Lighting::relightable,
                    .sun = {-1.5, 0.25}};
  model.hasNormals = model.hasColours = true;
  directory.sourceName = "city \xc3\xa4.ply";
  directory.sourceHash = 0x0123456789abcdef;
  directory.report.inputTriangles = 2;
  directory.report.inputVertices = 6;
  directory.report.skipped = {{"nonFinitePosition", 3}, {"zeroArea", 1}};
  directory.report.viewsBaked = 126;
  directory.report.viewsKept = 3;
  directory.report.viewsLeftOut = {{"empty", 123}};
  directory.report.impostorRawBytes = 2000;
  directory.cells.resize(3);
  directory.cells[0] = {.key = {},
                        .firstChild = 1,
                        .childCount = 2,
                        .content = {GridPoint(0), GridPoint((1 << 19) + 7, 1000, 0)},
                        .triangles = 2,
                        .firstViewPage = 0,
                        .viewPageCount = 2};
  directory.cells[1] = {.key = {1, 0, 0, 0},
                        .parent = 0,
                        .content = {GridPoint(0), GridPoint(1000, 1000, 0)},
                        .triangles = 1,
                        .meshTriangles = 1,
                        .firstGeometryPage = 2,
                        .geometryPageCount = 1,
                        .firstTexturePage = 5,
                        .texturePageCount = 2};
  directory.cells[2] = {.key = {1, 1, 0, 0},
                        .parent = 0,
                        .content = {GridPoint(1 << 19, 0, 0), GridPoint((1 << 19) + 7, 7, 0)},
                        .triangles = 1,
                        .meshTriangles = 1,
                        .firstGeometryPage = 3,
                        .geometryPageCount = 1,
                        .firstViewPage = 4,
                        .viewPageCount = 1,
                        .firstTexturePage = 5,
                        .texturePageCount = 2};
  for (CellRecord& cell : directory.cells) cell.form = model.settings.form;
  return directory;
}

inline FullPack fullPack() {
  std::mt19937 random(7);
  FullPack pack;
  pack.directory = fullDirectory();
  pack.geometry = {cornerTriangle(1000), cornerTriangle(7)};
  const Viewpoints viewpoints = Viewpoints::create(42).value();
  const auto first = static_cast<uint32_t>(viewpoints.group(0));
  ViewPage inFirstGroup, empty;
  for (uint32_t view = 0; view < 42; ++view) {
    const auto group = static_cast<uint32_t>(viewpoints.group(static_cast<int>(view)));
    if (group == first && inFirstGroup.views.size() < 2)
      inFirstGroup.views.push_back(randomView(random, view, 16, true, 1 + static_cast<int>(view % 2)));
    if (group == first + 1 && empty.views.empty()) {
      empty.views.emplace_back();
      empty.views[0].view = view;
    }
  }
  pack.views = {inFirstGroup, empty, inFirstGroup};
  // Few bytes, although more texels than are coarse.
  pack.atlas = {264, 256, 3, 4, 0, {}};
  for (uint32_t level = 0; level < 4; ++level)
    pack.atlas.levels.emplace_back(size_t{3} * (264 >> level) * (256 >> level), static_cast<uint8_t>(50 * level));
  return pack;
}

inline void write(const FullPack& pack, const std::filesystem::path& path) {
  Result<PackWriter> writer = PackWriter::create(path);
  FARCELL_CHECK(writer.has_value());
  const auto group = static_cast<uint32_t>(Viewpoints::create(42)->group(0));
  const auto add = [&](PageKind kind, uint32_t cell, uint32_t pageGroup, const auto& page, const Bytes& stored) {
    FARCELL_CHECK(writer->add(kind, cell, pageGroup, decodedSizeBytes(page), stored).has_value());
  };
  add(PageKind::views, 0, group, pack.views[0], encodeViewPage(pack.views[0]));
  add(PageKind::views, 0, group + 1, pack.views[1], encodeViewPage(pack.views[1]));
  add(PageKind::geometry, 1, 0, pack.geometry[0], encodeGeometryPage(pack.geometry[0]));
  add(PageKind::geometry, 2, 0, pack.geometry[1], encodeGeometryPage(pack.geometry[1]));
  add(PageKind::views, 2, group, pack.views[2], encodeViewPage(pack.views[2]));
  uint32_t textureGroup = 0;
  for (const TexturePage& page : pagesOfAtlas(pack.atlas))
    add(PageKind::texture, 1, textureGroup++, page, encodeTexturePage(page));
  FARCELL_CHECK(writer->finish(pack.directory).has_value());
}

// The pack's pages with another directory behind them, every checksum right: only what the fields say can be wrong.
inline Bytes withDirectory(std::span<const std::byte> pack, const Directory& directory, uint64_t directoryOffset,
                           std::span<const std::byte> directoryBytes) {
  Bytes result(pack.begin(), pack.begin() + static_cast<ptrdiff_t>(directoryOffset));
  result.insert(result.end(), directoryBytes.begin(), directoryBytes.end());
  const Bytes footer =
      encodeFooter({directoryOffset, directoryBytes.size(), hashBytes(directoryBytes),
                    hashSettings(directory.model.settings), directory.sourceHash, result.size() + kFooterBytes});
  result.insert(result.end(), footer.begin(), footer.end());
  return result;
}

}  // namespace farcell::samples
