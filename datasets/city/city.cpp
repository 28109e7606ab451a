#include "datasets/city/city.h"

#include <bit>
#include <cstring>
#include <functional>
#include <limits>
#include <vector>

#include "cache/base/file.h"
#include "cache/base/interrupt.h"
#include "cache/base/parallel.h"
#include "datasets/city/block.h"

namespace farcell {
namespace {

using city::Mesh;
static_assert(std::endian::native == std::endian::little);

constexpr uint64_t kUnbounded = std::numeric_limits<uint64_t>::max();
constexpr size_t kBatchBlocks = 8;  // generated together; bounds the memory
constexpr size_t kVertexBytes = 15;
constexpr size_t kFaceBytes = 13;

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

std::string plyHeader(const CitySettings& settings, const CityCounts& counts) {
  constexpr uint64_t kMaxInt = std::numeric_limits<int32_t>::max();
  return fmt::format(
      "ply\nformat binary_little_endian 1.0\ncomment farcell city, seed {}\nelement vertex {}\nproperty float x\n"
      "property float y\nproperty float z\nproperty uchar red\nproperty uchar green\nproperty uchar blue\n"
      "element face {}\nproperty list uchar {} vertex_indices\nend_header\n",
      settings.seed, counts.vertices, counts.triangles, counts.vertices > kMaxInt ? "uint" : "int");
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
  constexpr uint64_t kMaxVertices = std::numeric_limits<uint32_t>::max();
  if (plan.counts.vertices > kMaxVertices)
    return fail(ErrorKind::unsupported, "a city of {} triangles has {} vertices; a PLY file can name at most {}",
                plan.counts.triangles, plan.counts.vertices, kMaxVertices);
  plan.counts.bytes = plyHeader(settings, plan.counts).size() + plan.counts.vertices * kVertexBytes +
                      plan.counts.triangles * kFaceBytes;
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

void serialiseVertices(const Mesh& mesh, std::vector<std::byte>& out) {
  out.resize(mesh.vertices().size() * kVertexBytes);
  std::byte* at = out.data();
  for (const city::Vertex& vertex : mesh.vertices()) {
    std::memcpy(at, &vertex.x, 12);
    std::memcpy(at + 12, &vertex.colour, 3);
    at += kVertexBytes;
  }
}

void serialiseFaces(const Mesh& mesh, uint64_t firstVertex, std::vector<std::byte>& out) {
  out.resize(mesh.triangles().size() * kFaceBytes);
  std::byte* at = out.data();
  for (std::array<uint32_t, 3> triangle : mesh.triangles()) {
    for (uint32_t& index : triangle) index += static_cast<uint32_t>(firstVertex);
    *at = std::byte{3};
    std::memcpy(at + 1, triangle.data(), 12);
    at += kFaceBytes;
  }
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
  const std::string header = plyHeader(settings, plan.counts);
  FARCELL_TRY(file.append(std::as_bytes(std::span(header))));
  std::vector<std::byte> bytes;
  progress.begin("vertices", plan.counts.vertices, "vertices");
  FARCELL_TRY(forEachPlanned(settings, plan, [&](const Mesh& mesh) {
    serialiseVertices(mesh, bytes);
    progress.advance(mesh.vertices().size());
    return file.append(bytes);
  }));
  progress.begin("faces", plan.counts.triangles, "triangles");
  uint64_t firstVertex = 0;
  FARCELL_TRY(forEachPlanned(settings, plan, [&](const Mesh& mesh) {
    serialiseFaces(mesh, firstVertex, bytes);
    firstVertex += mesh.vertices().size();
    progress.advance(mesh.triangles().size());
    return file.append(bytes);
  }));
  FARCELL_TRY(file.commit());
  progress.end();
  return plan.counts;
}

}  // namespace farcell
