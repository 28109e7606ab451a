#include "datasets/city/city.h"

#include <functional>
#include <limits>
#include <vector>

#include "cache/base/file.h"
#include "cache/base/interrupt.h"
#include "cache/base/parallel.h"
#include "datasets/city/block.h"
#include "datasets/ply/ply_output.h"

namespace farcell {
namespace {

using city::Mesh;

constexpr uint64_t kUnbounded = std::numeric_limits<uint64_t>::max();
constexpr size_t kBatchBlocks = 8;  // generated together; bounds the memory

// Which blocks make the city: the first ones of the spiral, the last one only in part.
struct Plan {
  uint64_t wholeBlocks = 0;
  uint64_t lastBlockTriangles = 0;  // at most, in the block after them
  CityCounts counts;
};

// Takes a block's mesh; false stops.
using TakeBlock = std::function<Result<bool>(const Mesh& mesh)>;

// The whole blocks [0, count), in order, until `take` has had enough.
Result<> forEachBlock(const CitySettings& settings, uint64_t count, const TakeBlock& take) {
  const int threads = threadCount(settings.threads);
  std::vector<Mesh> meshes(kBatchBlocks);
  for (uint64_t first = 0; first < count; first += kBatchBlocks) {
    FARCELL_TRY(checkInterrupt());
    const size_t batch = std::min<uint64_t>(kBatchBlocks, count - first);
    parallelFor(batch, threads, [&](size_t i, int) {
      city::buildBlock(meshes[i], settings.seed, city::blockAt(first + i), kUnbounded);
    });
    for (size_t i = 0; i < batch; ++i) {
      FARCELL_ASSIGN(const bool more, take(meshes[i]));
      if (!more) return {};
    }
  }
  return {};
}

void addCounts(CityCounts& counts, const Mesh& mesh) {
  counts.triangles += mesh.triangles().size();
  counts.vertices += mesh.vertices().size();
  ++counts.blocks;
}

PlyLayout layoutOf(const CitySettings& settings, const CityCounts& counts) {
  return {fmt::format("farcell city, seed {}", settings.seed), counts.vertices, counts.triangles};
}

Result<Plan> planCity(const CitySettings& settings, Progress& progress) {
  if (settings.triangles < kMinCityTriangles)
    return fail(ErrorKind::invalidArgument, "a city needs at least {} triangles, found {}", kMinCityTriangles,
                settings.triangles);
  progress.begin("plan", settings.triangles, "triangles");
  Plan plan;
  FARCELL_TRY(forEachBlock(settings, kUnbounded, [&](const Mesh& mesh) -> Result<bool> {
    if (plan.counts.triangles + mesh.triangles().size() > settings.triangles) return false;
    addCounts(plan.counts, mesh);
    progress.advance(mesh.triangles().size());
    return true;
  }));
  plan.wholeBlocks = plan.counts.blocks;
  plan.lastBlockTriangles = settings.triangles - plan.counts.triangles;
  Mesh last;
  city::buildBlock(last, settings.seed, city::blockAt(plan.wholeBlocks), plan.lastBlockTriangles);
  addCounts(plan.counts, last);
  const PlyLayout layout = layoutOf(settings, plan.counts);
  FARCELL_TRY(checkPlyLayout(layout));
  plan.counts.bytes = plyBytes(layout);
  return plan;
}

Result<> forEachPlanned(const CitySettings& settings, const Plan& plan,
                        const std::function<Result<>(const Mesh&)>& take) {
  FARCELL_TRY(forEachBlock(settings, plan.wholeBlocks, [&](const Mesh& mesh) -> Result<bool> {
    FARCELL_TRY(take(mesh));
    return true;
  }));
  Mesh last;
  city::buildBlock(last, settings.seed, city::blockAt(plan.wholeBlocks), plan.lastBlockTriangles);
  return take(last);
}

void putVertices(const Mesh& mesh, std::vector<PlyVertex>& vertices, std::vector<std::byte>& out) {
  vertices.clear();
  for (const city::Vertex& vertex : mesh.vertices())
    vertices.push_back(
        {glm::dvec3(vertex.x, vertex.y, vertex.z), {vertex.colour.red, vertex.colour.green, vertex.colour.blue}});
  putPlyVertices(vertices, false, out);
}

}  // namespace

Result<CityCounts> countCity(const CitySettings& settings, Progress& progress) {
  FARCELL_ASSIGN(const Plan plan, planCity(settings, progress));
  progress.end();
  return plan.counts;
}

Result<CityCounts> writeCity(const CitySettings& settings, const std::filesystem::path& path, Progress& progress) {
  FARCELL_ASSIGN(OutputFile file, OutputFile::create(path));
  FARCELL_ASSIGN(const Plan plan, planCity(settings, progress));
  const std::string header = plyHeader(layoutOf(settings, plan.counts));
  FARCELL_TRY(file.append(std::as_bytes(std::span(header))));
  std::vector<PlyVertex> vertices;
  std::vector<std::byte> bytes;
  progress.begin("vertices", plan.counts.vertices, "vertices");
  FARCELL_TRY(forEachPlanned(settings, plan, [&](const Mesh& mesh) {
    bytes.clear();
    putVertices(mesh, vertices, bytes);
    progress.advance(mesh.vertices().size());
    return file.append(bytes);
  }));
  progress.begin("faces", plan.counts.triangles, "triangles");
  uint64_t firstVertex = 0;
  FARCELL_TRY(forEachPlanned(settings, plan, [&](const Mesh& mesh) {
    bytes.clear();
    putPlyFaces(mesh.triangles(), firstVertex, bytes);
    firstVertex += mesh.vertices().size();
    progress.advance(mesh.triangles().size());
    return file.append(bytes);
  }));
  FARCELL_TRY(file.commit());
  progress.end();
  return plan.counts;
}

}  // namespace farcell
