#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

#include "cache/base/interrupt.h"
#include "cache/base/parallel.h"
#include "preprocess/mesh/source_hash.h"
#include "preprocess/read/open_mesh.h"
#include "shaders/shared/shading.h"
#include "tools/evaluate/reference/reference.h"
#include "tools/evaluate/reference/tracer.h"

namespace farcell {
namespace {

constexpr uint64_t kMaxTriangles = std::numeric_limits<uint32_t>::max() / 3;  // three positions each, 32-bit indices

// What messages call the mesh: its first file.
std::string nameOf(const MeshReader& mesh) { return mesh.files()[0].string(); }

Result<> checkSource(const MeshReader& mesh, const Directory& directory) {
  FARCELL_ASSIGN(const uint64_t hash, sourceHash(mesh));
  if (hash == directory.sourceHash) return {};
  return fail(ErrorKind::invalidArgument,
              "{}: hash {:016x}, but the pack was built from '{}' with hash {:016x}: it is not the same source",
              nameOf(mesh), hash, directory.sourceName, directory.sourceHash);
}

uint32_t octahedralBits(glm::vec3 unit) {
  const glm::vec2 p = shared::octahedralFromUnit(unit);
  const auto bits = [](float value) {
    return static_cast<uint32_t>(static_cast<uint16_t>(std::lround(value * 32767.0f)));
  };
  return bits(p.x) | bits(p.y) << 16;
}

// Corners whose normal says nothing take the face's.
uint32_t cornerNormal(const InputTriangle& triangle, size_t corner) {
  const glm::dvec3 given(triangle.normals[corner]);
  if (const double length = glm::length(given); std::isfinite(length) && length > 0)
    return octahedralBits(glm::vec3(given / length));
  const glm::dvec3 face =
      glm::cross(triangle.positions[1] - triangle.positions[0], triangle.positions[2] - triangle.positions[0]);
  const double length = glm::length(face);
  return octahedralBits(length > 0 ? glm::vec3(face / length) : glm::vec3(0, 0, 1));
}

// The model's box becomes one of half diagonal 1 around the origin.
LocalTriangles emptyModel(const Model& model) {
  LocalTriangles local;
  local.min = model.grid.worldFromGrid(model.bounds.min);
  local.max = model.grid.worldFromGrid(model.bounds.max);
  local.origin = (local.min + local.max) * 0.5;
  local.unit = std::max(glm::length(local.max - local.min) * 0.5, std::numeric_limits<double>::min());
  return local;
}

void appendTriangle(LocalTriangles& local, const InputTriangle& triangle, const MeshInfo& info) {
  const auto first = static_cast<uint32_t>(local.positions.size());
  for (size_t corner = 0; corner < 3; ++corner) {
    const glm::dvec3& world = triangle.positions[corner];
    local.min = glm::min(local.min, world);
    local.max = glm::max(local.max, world);
    local.positions.emplace_back((world - local.origin) / local.unit);
    if (info.hasColours) local.colours.push_back(triangle.colours[corner]);
    if (info.hasNormals) local.normals.push_back(cornerNormal(triangle, corner));
  }
  local.triangles.emplace_back(first, first + 1, first + 2);
  if (local.textures.empty()) return;
  local.textureOf.push_back(triangle.texture);
  local.coordinates.insert(local.coordinates.end(), triangle.textureCoordinates.begin(),
                           triangle.textureCoordinates.end());
}

Result<LocalTriangles> readTriangles(MeshReader& mesh, const Directory& directory,
                                     const std::function<void(uint64_t)>& progress) {
  LocalTriangles local = emptyModel(directory.model);
  FARCELL_ASSIGN(local.textures, WholeTextures::read(mesh.textures()));
  const auto sink = [&](std::span<const InputTriangle> batch) -> Result<> {
    FARCELL_TRY(checkInterrupt());
    if (local.triangles.size() + batch.size() > kMaxTriangles)
      return fail(ErrorKind::unsupported, "{}: more than {} triangles", nameOf(mesh), kMaxTriangles);
    for (const InputTriangle& triangle : batch) appendTriangle(local, triangle, mesh.info());
    progress(batch.size());
    return {};
  };
  FARCELL_TRY(mesh.forEachTriangle(sink));
  return local;
}

}  // namespace

struct MeshReference::Impl {
  EmbreeDevice device;  // outlives the scene
  TracedGeometry geometry;
  BuildSettings settings;  // of the pack
};

MeshReference::MeshReference(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
MeshReference::MeshReference(MeshReference&&) noexcept = default;
MeshReference::~MeshReference() = default;

Result<MeshReference> MeshReference::load(std::span<const std::filesystem::path> meshes, const Directory& directory,
                                          const std::function<void(uint64_t triangles)>& progress) {
  FARCELL_ASSIGN(const std::unique_ptr<MeshReader> mesh, openMeshes(meshes));
  FARCELL_TRY(checkSource(*mesh, directory));
  FARCELL_ASSIGN(LocalTriangles triangles, readTriangles(*mesh, directory, progress));
  FARCELL_ASSIGN(EmbreeDevice device, createEmbreeDevice(0));
  FARCELL_ASSIGN(TracedGeometry geometry, buildTracedGeometry(device.get(), std::move(triangles)));
  return MeshReference(std::make_unique<Impl>(Impl{std::move(device), std::move(geometry), directory.model.settings}));
}

uint64_t MeshReference::triangles() const { return impl_->geometry.triangles.triangles.size(); }

Result<ReferenceImage> MeshReference::trace(const Camera& camera, const ReferenceSettings& settings) const {
  FARCELL_TRY(checkReferenceSamples(settings.samples));
  FARCELL_TRY(checkInterrupt());
  const int perAxis = static_cast<int>(std::lround(std::sqrt(settings.samples)));
  SampleImage image(referenceView(camera, settings.width, settings.height), perAxis,
                    lightDirection(settings.light, impl_->settings, camera));
  image.trace({&impl_->geometry, 1}, threadCount(settings.threads));
  return image.finish();
}

}  // namespace farcell
