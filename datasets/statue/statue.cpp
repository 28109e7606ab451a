#include "datasets/statue/statue.h"

#include <algorithm>
#include <cmath>
#include <functional>

#include "cache/base/file.h"
#include "cache/base/interrupt.h"
#include "cache/base/parallel.h"
#include "datasets/ply/ply_output.h"
#include "datasets/statue/moai.h"
#include "datasets/statue/relief.h"
#include "datasets/statue/subdivision.h"
#include "datasets/statue/surface_nets.h"

namespace farcell {
namespace {

constexpr size_t kPartSize = 16'384;  // vertices or faces made at once
constexpr size_t kBatchParts = 32;    // made together; bounds the memory
constexpr double kMostCells = 240;    // the figure's lattice, over its height: finer shows nothing more
constexpr double kFinestLayerEdges = 2;
constexpr double kFloatShows = 1.0 / 64;  // of an edge: coarser steps of a float would show

using MakePart = std::function<void(uint64_t first, size_t count, std::vector<std::byte>& out)>;

// [0, total) in parts, made by several threads, written in order.
Result<> writeParts(OutputFile& file, uint64_t total, int threads, Progress& progress, const MakePart& make) {
  std::vector<std::vector<std::byte>> parts(kBatchParts);
  for (uint64_t first = 0; first < total; first += kBatchParts * kPartSize) {
    FARCELL_TRY(checkInterrupt());
    const uint64_t count = std::min<uint64_t>(total - first, kBatchParts * kPartSize);
    const auto used = static_cast<size_t>((count + kPartSize - 1) / kPartSize);
    parallelFor(used, threads, [&](size_t i, int) {
      parts[i].clear();
      make(first + i * kPartSize, std::min<uint64_t>(kPartSize, count - i * kPartSize), parts[i]);
    });
    for (size_t i = 0; i < used; ++i) FARCELL_TRY(file.append(parts[i]));
    progress.advance(count);
  }
  return {};
}

Result<> checkSettings(const BaseMesh& base, const StatueSettings& settings) {
  if (!(settings.amplitude >= 0 && settings.amplitude <= 0.1))
    return fail(ErrorKind::invalidArgument, "amplitude: expected 0 to 0.1, found {}", settings.amplitude);
  if (!(settings.roughness >= 0 && settings.roughness <= 0.9))
    return fail(ErrorKind::invalidArgument, "roughness: expected 0 to 0.9, found {}", settings.roughness);
  if (settings.triangles < base.triangles.size())
    return fail(ErrorKind::invalidArgument, "the mesh has {} triangles already; expected at least as many, found {}",
                base.triangles.size(), settings.triangles);
  return {};
}

// Whether floats are too coarse: steps there against the edges that are wished for.
bool needsDoubles(const BaseMesh& base, double edgeLength) {
  double farthest = 0;
  for (int axis = 0; axis < 3; ++axis) farthest = std::max(farthest, std::abs(base.middle[axis]) + base.diagonal);
  return std::ldexp(farthest, -24) > edgeLength * base.diagonal * kFloatShows || farthest > 1e38 || farthest < 1e-30;
}

}  // namespace

Result<BaseMesh> makeFigure(const StatueSettings& settings) {
  if (settings.triangles < kMinStatueTriangles)
    return fail(ErrorKind::invalidArgument, "a statue needs at least {} triangles, found {}", kMinStatueTriangles,
                settings.triangles);
  const Moai moai(settings.seed);
  const Field field{Moai::kMin, Moai::kMax, [&](glm::dvec3 p) { return moai.distance(p); },
                    [&](glm::dvec3 p) { return moai.colour(p); }};
  const int threads = threadCount(settings.threads);
  // Triangles grow with the square of the cells; few are left for small statues.
  double cells = std::min(kMostCells, 0.6 * std::sqrt(static_cast<double>(settings.triangles)));
  for (;; cells *= 0.9) {
    FARCELL_ASSIGN(BaseMesh mesh, surfaceNets(field, (Moai::kMax.z - Moai::kMin.z) / cells, threads));
    if (mesh.triangles.size() <= settings.triangles) return mesh;
  }
}

Result<StatueCounts> writeStatue(const BaseMesh& base, const StatueSettings& settings,
                                 const std::filesystem::path& path, Progress& progress) {
  FARCELL_TRY(checkSettings(base, settings));
  FARCELL_ASSIGN(OutputFile file, OutputFile::create(path));
  FARCELL_ASSIGN(const Subdivision subdivision, Subdivision::create(base, settings.triangles, settings.seed));
  const PlyLayout layout = {fmt::format("farcell statue, seed {}", settings.seed), subdivision.vertexCount(),
                            subdivision.faceCount(), needsDoubles(base, subdivision.edgeLength())};
  FARCELL_TRY(checkPlyLayout(layout));
  const Relief relief(
      base, {settings.seed, settings.amplitude, settings.roughness, kFinestLayerEdges * subdivision.edgeLength()});
  const int threads = threadCount(settings.threads);
  const std::string header = plyHeader(layout);
  FARCELL_TRY(file.append(std::as_bytes(std::span(header))));
  progress.begin("vertices", layout.vertices, "vertices");
  FARCELL_TRY(writeParts(file, layout.vertices, threads, progress,
                         [&](uint64_t first, size_t count, std::vector<std::byte>& out) {
                           std::vector<SurfacePoint> points(count);
                           std::vector<PlyVertex> vertices(count);
                           subdivision.points(first, points);
                           for (size_t i = 0; i < count; ++i) vertices[i] = relief.vertex(points[i]);
                           putPlyVertices(vertices, layout.isWide, out);
                         }));
  progress.begin("faces", layout.triangles, "triangles");
  FARCELL_TRY(writeParts(file, layout.triangles, threads, progress,
                         [&](uint64_t first, size_t count, std::vector<std::byte>& out) {
                           std::vector<std::array<uint32_t, 3>> faces(count);
                           subdivision.faces(first, faces);
                           putPlyFaces(faces, 0, out);
                         }));
  FARCELL_TRY(file.commit());
  progress.end();
  return StatueCounts{layout.triangles, layout.vertices, base.triangles.size(), plyBytes(layout)};
}

}  // namespace farcell
