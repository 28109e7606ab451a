#include "preprocess/partition/spool.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <glm/common.hpp>
#include <limits>

#include "cache/base/interrupt.h"
#include "preprocess/partition/grid_triangle.h"
#include "preprocess/partition/root_cube.h"

namespace farcell {
namespace {

constexpr uint64_t kMeasureMagic = 0x31727361'656d7470;  // "ptmeasr1"
constexpr int kMaxWorkers = 3;                           // one thread reads the mesh: more than that do not help it
constexpr uint64_t kSegments = 48;
constexpr uint64_t kMinPortionBytes = uint64_t{4} << 20;
constexpr std::chrono::seconds kFlushInterval{2};

std::optional<MeshMeasure> readMeasure(const std::filesystem::path& file) {
  MeshMeasure measure;
  std::optional<SealedReader> reader = SealedReader::open(file);
  uint64_t magic = 0;
  if (!reader || !reader->get(magic) || magic != kMeasureMagic || !reader->get(measure.grid) ||
      !getCounts(*reader, measure.counts))
    return std::nullopt;
  return measure;
}

Result<> writeMeasure(const std::filesystem::path& file, const MeshMeasure& measure) {
  SealedWriter writer;
  writer.put(kMeasureMagic);
  writer.put(measure.grid);
  putCounts(writer, measure.counts);
  return writer.commit(file);
}

// Where positions come to lie on a grid: the same points as gridFromWorld, without a call for each. The root cube's last
// plane, which no model touches, is left out: a record has no room for it.
class Gridding {
 public:
  explicit Gridding(const Grid& grid)
      : origin_(grid.origin), side_(grid.side), steps_(static_cast<double>(int64_t{1} << grid.bits)) {}
  GridPoint operator()(glm::dvec3 point) const {
    GridPoint result;
    for (int axis = 0; axis < 3; ++axis) {
      const double value = (point[axis] - origin_[axis]) / side_ * steps_ + 0.5;
      result[axis] = static_cast<int32_t>(std::min(std::max(value, 0.0), steps_ - 1));
    }
    return result;
  }

 private:
  glm::dvec3 origin_;
  double side_;
  double steps_;
};

// None where a coordinate is not finite.
TriangleTexture textureOf(const InputTriangle& triangle) {
  if (triangle.texture == kNoTexture) return {};
  for (const glm::vec2& at : triangle.textureCoordinates)
    if (!std::isfinite(at.x) || !std::isfinite(at.y)) return {};
  return {triangle.texture, triangle.textureCoordinates};
}

// The input's looks join its corners.
void putLooks(const InputTriangle& input, const RecordFormat& format, GridTriangle triangle, std::byte* record) {
  for (int k = 0; k < 3; ++k) {
    triangle.colours[k] = format.colours ? input.colours[k] : 0;
    if (format.normals) triangle.normals[k] = packNormal(input.normals[k]);
  }
  format.put(triangle, format.textures ? textureOf(input) : TriangleTexture{}, record);
}

BucketBuilder::Limits limitsFor(uint64_t expectedBytes, const SpoolOptions& options) {
  BucketBuilder::Limits limits{kMinPortionBytes, std::clamp(options.threads - 1, 0, kMaxWorkers)};
  while (limits.workers > 0 && BucketBuilder::memoryBytes(limits) > options.memoryBytes) --limits.workers;
  const uint64_t wanted = std::max(kMinPortionBytes, expectedBytes / kSegments);
  limits.portionBytes = wanted;
  while (limits.portionBytes > kMinPortionBytes && BucketBuilder::memoryBytes(limits) > options.memoryBytes)
    limits.portionBytes -= limits.portionBytes / 8;
  return limits;
}

}  // namespace

void putCounts(SealedWriter& writer, const MeshCounts& counts) {
  writer.put(counts.accepted);
  writer.put(uint64_t{counts.skipped.size()});
  for (const auto& [reason, triangles] : counts.skipped) {
    writer.put(reason);
    writer.put(triangles);
  }
}

bool getCounts(SealedReader& reader, MeshCounts& counts) {
  uint64_t reasons = 0, triangles = 0;
  if (!reader.get(counts.accepted) || !reader.get(reasons)) return false;
  for (std::string reason; reasons > 0; --reasons) {
    if (!reader.get(reason) || !reader.get(triangles)) return false;
    counts.skipped[reason] = triangles;
  }
  return true;
}

RecordFormat recordFormatOf(const MeshReader& mesh) {
  return {mesh.info().hasColours, mesh.info().hasNormals, !mesh.textures().empty()};
}

Result<MeshMeasure> measureMesh(MeshReader& mesh, const BuildSettings& settings, const std::filesystem::path& file,
                                Progress& progress) {
  if (std::optional<MeshMeasure> measure = readMeasure(file)) return *std::move(measure);
  glm::dvec3 least(std::numeric_limits<double>::infinity()), greatest(-least);
  TriangleSample sample;
  progress.begin("measure", mesh.info().declaredTriangles, "triangles");
  const auto grow = [&](std::span<const InputTriangle> batch) -> Result<> {
    glm::dvec3 min = least, max = greatest;
    for (const InputTriangle& triangle : batch) {
      for (const glm::dvec3& position : triangle.positions) {
        min = glm::min(min, position);
        max = glm::max(max, position);
      }
      sample.add(triangle.positions[0]);
    }
    least = min;
    greatest = max;
    progress.advance(batch.size());
    return checkInterrupt();
  };
  FARCELL_ASSIGN(MeshCounts counts, mesh.forEachTriangle(grow));
  if (counts.accepted == 0)
    return fail(ErrorKind::corrupt, "expected at least one triangle with an area, found none among {}",
                mesh.info().declaredTriangles);
  MeshMeasure measure{rootCube(gridAround(least, greatest), sample, settings), std::move(counts)};
  FARCELL_TRY(writeMeasure(file, measure));
  return measure;
}

Result<std::shared_ptr<const BucketFile>> spoolMesh(MeshReader& mesh, const Grid& grid, uint64_t triangles,
                                                    const SpoolOptions& options, Progress& progress) {
  const RecordFormat format = recordFormatOf(mesh);
  FARCELL_ASSIGN(const auto builder,
                 BucketBuilder::open(options.file, BucketLayout(CellKey{}, grid.bits, options.depth), format,
                                     limitsFor(triangles * format.bytes(), options)));
  if (builder->complete()) return builder->finish(triangles);
  progress.begin("spool", triangles, "triangles");
  const Gridding gridding(grid);
  uint64_t seen = 0;
  auto flushed = std::chrono::steady_clock::now();
  const auto flush = [&]() -> Result<> {
    flushed = std::chrono::steady_clock::now();
    return builder->flush(seen);
  };
  const auto put = [&](std::span<const InputTriangle> batch) -> Result<> {
    const uint64_t skip =
        std::min<uint64_t>(batch.size(), builder->sourceDone() - std::min(seen, builder->sourceDone()));
    seen += skip;
    for (const InputTriangle& input : batch.subspan(skip)) {
      if (builder->full()) FARCELL_TRY(flush());
      ++seen;
      GridTriangle triangle;
      for (int k = 0; k < 3; ++k) triangle.corners[k] = gridding(input.positions[k]);
      if (isDegenerate(triangle)) continue;  // thinner than the grid: its neighbours meet where it was
      putLooks(input, format, triangle, builder->slot());
      builder->take();
    }
    progress.advance(batch.size());
    if (std::chrono::steady_clock::now() - flushed > kFlushInterval) FARCELL_TRY(flush());
    return checkInterrupt();
  };
  FARCELL_TRY(mesh.forEachTriangle(put));
  return builder->finish(seen);
}

}  // namespace farcell
