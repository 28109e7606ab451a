#include <algorithm>
#include <cmath>

#include "cache/base/interrupt.h"
#include "cache/base/parallel.h"
#include "tools/evaluate/reference/leaves.h"
#include "tools/evaluate/reference/reference.h"
#include "tools/evaluate/reference/tracer.h"

namespace farcell {
namespace {

// What is in memory at once: enough leaves to keep all threads busy, no more triangles than this beyond one leaf.
constexpr size_t kBatchLeaves = 64;
constexpr uint64_t kBatchTriangles = 500'000;

// A leaf's cube becomes [-1, 1]^3.
LocalTriangles localFrame(const Grid& grid, const CellRecord& cell) {
  LocalTriangles local;
  local.origin = cellCentre(grid, cell.key);
  local.unit = cellHalfSide(grid, cell.key);
  local.min = grid.worldFromGrid(cell.content.min);
  local.max = grid.worldFromGrid(cell.content.max);
  return local;
}

// Grid steps have at most 24 bits, so positions are exact.
void append(const GeometryPage& page, float steps, LocalTriangles& local) {
  const auto first = static_cast<uint32_t>(local.positions.size());
  for (const glm::uvec3& p : page.positions) local.positions.push_back(glm::vec3(p) * (2 / steps) - glm::vec3(1));
  for (size_t i = 0; i + 2 < page.indices.size(); i += 3)
    local.triangles.push_back(glm::uvec3(page.indices[i], page.indices[i + 1], page.indices[i + 2]) + first);
  local.colours.insert(local.colours.end(), page.colours.begin(), page.colours.end());
  local.normals.insert(local.normals.end(), page.normals.begin(), page.normals.end());
}

// 0xAABBGGRR, of a texel premultiplied by alpha.
uint32_t straight(const uint8_t* texel, uint32_t alpha) {
  uint32_t pixel = alpha << 24;
  for (int channel = 0; channel < 3; ++channel)
    pixel |= std::min(255u, (255u * texel[channel] + alpha / 2) / std::max(1u, alpha)) << 8 * channel;
  return pixel;
}

// The finest level, as an image of the model's: its top row first.
TextureImage imageOf(const TexturePage& atlas) {
  TextureImage image{static_cast<int>(atlas.width), static_cast<int>(atlas.height), {}};
  for (uint32_t row = atlas.height; row-- > 0;) {
    const uint8_t* texel = atlas.levels[0].data() + size_t{row} * atlas.width * atlas.channels;
    for (uint32_t x = 0; x < atlas.width; ++x, texel += atlas.channels)
      image.pixels.push_back(straight(texel, atlas.channels == 4 ? texel[3] : 255));
  }
  return image;
}

// What a page that was appended looks at.
Result<> appendAtlas(const PackFile& pack, uint32_t cell, uint32_t part, const GeometryPage& page,
                     LocalTriangles& local) {
  const bool there = !page.coordinates.empty();
  local.textureOf.insert(local.textureOf.end(), page.indices.size() / 3, there ? part : kNoTexture);
  for (size_t i = 0; i < page.positions.size(); ++i)
    local.coordinates.push_back(there ? unpackedCoordinates(page.coordinates[i]) : glm::vec2(0));
  if (!there) {
    local.textures.add({}, AlphaMode::opaque);
    return {};
  }
  FARCELL_ASSIGN(const TexturePage atlas, pack.readAtlas(cell, part));
  local.textures.add(imageOf(atlas), atlas.channels == 4 ? AlphaMode::blend : AlphaMode::opaque);
  return {};
}

Result<TracedGeometry> loadLeaf(const PackFile& pack, uint32_t cell, RTCDevice device) {
  const CellRecord& record = pack.directory().cells[cell];
  const Grid& grid = pack.directory().model.grid;
  LocalTriangles local = localFrame(grid, record);
  for (uint32_t part = 0; part < record.geometryPageCount; ++part) {
    FARCELL_ASSIGN(const GeometryPage page, pack.readGeometry(record.firstGeometryPage + part));
    append(page, std::ldexp(1.0f, grid.bits - static_cast<int>(record.key.level)), local);
    if (record.texturePageCount > 0) FARCELL_TRY(appendAtlas(pack, cell, part, page, local));
  }
  return buildTracedGeometry(device, std::move(local));
}

// The next leaves that still have open samples in front of them.
std::vector<uint32_t> nextBatch(const std::vector<VisibleLeaf>& leaves, size_t& next, const Directory& directory,
                                const SampleImage& image) {
  std::vector<uint32_t> batch;
  uint64_t triangles = 0;
  for (; next < leaves.size() && batch.size() < kBatchLeaves && triangles < kBatchTriangles; ++next) {
    if (!image.unresolved(leaves[next].bounds)) continue;
    batch.push_back(leaves[next].cell);
    triangles += directory.cells[leaves[next].cell].triangles;
  }
  return batch;
}

Result<std::vector<TracedGeometry>> loadBatch(const PackFile& pack, const std::vector<uint32_t>& cells,
                                              RTCDevice device, int threads) {
  std::vector<TracedGeometry> batch(cells.size());
  std::vector<Result<>> results(cells.size());
  parallelFor(cells.size(), threads, [&](size_t i, int) {
    Result<TracedGeometry> leaf = loadLeaf(pack, cells[i], device);
    if (leaf)
      batch[i] = std::move(*leaf);
    else
      results[i] = tl::unexpected<Error>(std::move(leaf).error());
  });
  for (const Result<>& result : results) FARCELL_TRY(result);
  return batch;
}

}  // namespace

Result<> checkReferenceSamples(int samples) {
  for (int perAxis = 1; perAxis * perAxis <= kMaxReferenceSamples; ++perAxis)
    if (perAxis * perAxis == samples) return {};
  return fail(ErrorKind::invalidArgument, "reference samples: expected a square number from 1 to {}, found {}",
              kMaxReferenceSamples, samples);
}

Result<ReferenceImage> traceReference(const PackFile& pack, const Camera& camera, const ReferenceSettings& settings) {
  FARCELL_TRY(checkReferenceSamples(settings.samples));
  const int threads = threadCount(settings.threads);
  FARCELL_ASSIGN(const EmbreeDevice device, createEmbreeDevice(1));  // leaves are built side by side
  const ReferenceView view = referenceView(camera, settings.width, settings.height);
  const int perAxis = static_cast<int>(std::lround(std::sqrt(settings.samples)));
  SampleImage image(view, perAxis, lightDirection(settings.light, pack.directory().model.settings, camera));
  const std::vector<VisibleLeaf> leaves = leavesFrontToBack(pack.directory(), view);
  for (size_t next = 0; next < leaves.size();) {
    FARCELL_TRY(checkInterrupt());
    const std::vector<uint32_t> cells = nextBatch(leaves, next, pack.directory(), image);
    FARCELL_ASSIGN(const std::vector<TracedGeometry> batch, loadBatch(pack, cells, device.get(), threads));
    image.trace(batch, threads);
  }
  return image.finish();
}

}  // namespace farcell
