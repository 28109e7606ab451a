#include "preprocess/partition/spool.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <limits>

#include "cache/base/interrupt.h"
#include "cache/schema/model.h"
#include "preprocess/partition/grid_triangle.h"

namespace farcell {
namespace {

struct Bounds {
  glm::dvec3 min{std::numeric_limits<double>::infinity()};
  glm::dvec3 max{-std::numeric_limits<double>::infinity()};
  MeshCounts counts;
};

Result<Bounds> findBounds(MeshReader& mesh, Progress& progress) {
  Bounds bounds;
  progress.begin("measure", mesh.info().declaredTriangles, "triangles");
  const auto grow = [&](std::span<const InputTriangle> batch) -> Result<> {
    for (const InputTriangle& triangle : batch) {
      for (const glm::dvec3& position : triangle.positions) {
        bounds.min = glm::min(bounds.min, position);
        bounds.max = glm::max(bounds.max, position);
      }
    }
    progress.advance(batch.size());
    return checkInterrupt();
  };
  FARCELL_ASSIGN(bounds.counts, mesh.forEachTriangle(grow));
  return bounds;
}

GridTriangle onGrid(const InputTriangle& triangle, const Grid& grid, const MeshInfo& info) {
  const uint32_t albedo = kDefaultAlbedo[0] | kDefaultAlbedo[1] << 8 | kDefaultAlbedo[2] << 16;
  GridTriangle result{};
  for (int k = 0; k < 3; ++k) {
    result.corners[k] = grid.gridFromWorld(triangle.positions[k]);
    result.colours[k] = info.hasColours ? triangle.colours[k] & 0xffffff : albedo;
    result.normals[k] = info.hasNormals ? packNormal(triangle.normals[k]) : 0;
  }
  return result;
}

// None where a coordinate is not finite.
TriangleTexture textureOf(const InputTriangle& triangle) {
  if (triangle.texture == kNoTexture) return {};
  for (const glm::vec2& at : triangle.textureCoordinates)
    if (!std::isfinite(at.x) || !std::isfinite(at.y)) return {};
  return {triangle.texture, triangle.textureCoordinates};
}

// The histogram cell of a triangle's middle.
CellKey histogramCell(const GridTriangle& triangle, int gridBits) {
  const int shift = gridBits - static_cast<int>(kHistogramLevel);
  CellKey key{kHistogramLevel};
  std::array<uint32_t*, 3> coordinates = {&key.x, &key.y, &key.z};
  for (int axis = 0; axis < 3; ++axis) {
    const int64_t sum = int64_t{triangle.corners[0][axis]} + triangle.corners[1][axis] + triangle.corners[2][axis];
    *coordinates[axis] = std::min(static_cast<uint32_t>(sum / 3 >> shift), (1u << kHistogramLevel) - 1);
  }
  return key;
}

void sumLevels(std::array<std::vector<uint64_t>, kHistogramLevel + 1>& histogram) {
  for (int level = kHistogramLevel - 1; level >= 0; --level)
    for (size_t cell = 0; cell < histogram[level].size(); ++cell)
      for (size_t child = 0; child < 8; ++child) histogram[level][cell] += histogram[level + 1][8 * cell + child];
}

}  // namespace

Result<Spool> spoolMesh(MeshReader& mesh, const std::filesystem::path& scratchDirectory, Progress& progress) {
  FARCELL_ASSIGN(const Bounds bounds, findBounds(mesh, progress));
  if (bounds.counts.accepted == 0)
    return fail(ErrorKind::corrupt, "expected at least one triangle with an area, found none among {}",
                mesh.info().declaredTriangles);
  FARCELL_ASSIGN(TriangleLists triangles, TriangleLists::create(scratchDirectory, 1));
  Spool spool{gridAround(bounds.min, bounds.max), {}, bounds.counts, std::move(triangles), {}};
  for (uint32_t level = 0; level <= kHistogramLevel; ++level) spool.histogram[level].resize(size_t{1} << 3 * level);

  progress.begin("spool", bounds.counts.accepted, "triangles");
  GridTriangles batchOnGrid;
  const auto put = [&](std::span<const InputTriangle> batch) -> Result<> {
    batchOnGrid.clear();
    for (const InputTriangle& input : batch) {
      const GridTriangle triangle = onGrid(input, spool.grid, mesh.info());
      if (isDegenerate(triangle)) continue;  // thinner than the grid: its neighbours meet where it was
      batchOnGrid.add(triangle, textureOf(input));
      spool.bounds.include(boxOf(triangle));
      ++spool.histogram[kHistogramLevel][mortonCode(histogramCell(triangle, spool.grid.bits))];
    }
    progress.advance(batch.size());
    FARCELL_TRY(checkInterrupt());
    return spool.triangles.append(0, batchOnGrid);
  };
  FARCELL_TRY(mesh.forEachTriangle(put));
  if (spool.bounds.empty())
    return fail(ErrorKind::corrupt, "expected a triangle wider than {} of the model's extent, found none",
                1.0 / (int64_t{1} << spool.grid.bits));
  sumLevels(spool.histogram);
  return spool;
}

}  // namespace farcell
