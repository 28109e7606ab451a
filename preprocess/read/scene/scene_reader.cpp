#include "preprocess/read/scene/scene_reader.h"

#include <algorithm>
#include <limits>
#include <set>

#include "cache/base/check.h"
#include "preprocess/mesh/triangle_batch.h"

namespace farcell {
namespace {

// sum += count * times. False, and sum unchanged, when it cannot be counted.
bool addProduct(uint64_t& sum, uint64_t count, uint64_t times) {
  const uint64_t left = std::numeric_limits<uint64_t>::max() - sum;
  if (count > left / times) return false;
  sum += count * times;
  return true;
}

class SceneReader final : public MeshReader {
 public:
  SceneReader(std::vector<ScenePart> parts, std::filesystem::path file, MeshInfo info)
      : parts_(std::move(parts)), file_(std::move(file)), info_(std::move(info)) {
    for (const ScenePart& part : parts_) {
      const std::span<const TextureSource> textures = part.mesh->textures();
      textures_.insert(textures_.end(), textures.begin(), textures.end());
    }
  }

  const MeshInfo& info() const override { return info_; }
  std::span<const TextureSource> textures() const override { return textures_; }
  std::vector<std::filesystem::path> files() const override;
  Result<MeshCounts> forEachTriangle(const Sink& sink) override;

 private:
  void addPlaced(const ScenePart& part, std::span<const InputTriangle> triangles, uint32_t firstTexture,
                 TriangleBatch& batch) const;

  std::vector<ScenePart> parts_;
  std::filesystem::path file_;
  MeshInfo info_;
  std::vector<TextureSource> textures_;
};

std::vector<std::filesystem::path> SceneReader::files() const {
  std::vector<std::filesystem::path> files;
  if (!file_.empty()) files.push_back(file_);
  std::set<std::filesystem::path> known;
  for (const ScenePart& part : parts_)
    for (const std::filesystem::path& path : part.mesh->files())
      if (known.insert(path.lexically_normal()).second) files.push_back(path);
  return files;
}

void SceneReader::addPlaced(const ScenePart& part, std::span<const InputTriangle> triangles, uint32_t firstTexture,
                            TriangleBatch& batch) const {
  const MeshInfo& info = part.mesh->info();
  for (const Placement& placement : part.placements) {
    for (const InputTriangle& triangle : triangles) {
      InputTriangle placed = placement.apply(triangle);
      if (!info.hasColours) placed.colours.fill(defaultColour());
      if (!info.hasNormals) placed.normals.fill(info_.hasNormals ? faceNormal(placed) : glm::vec3(0));
      if (placed.texture != kNoTexture) placed.texture += firstTexture;
      batch.add(placed);
    }
  }
}

Result<MeshCounts> SceneReader::forEachTriangle(const Sink& sink) {
  TriangleBatch batch(sink);
  MeshCounts before;
  uint32_t firstTexture = 0;
  for (const ScenePart& part : parts_) {
    const Result<MeshCounts> counts = part.mesh->forEachTriangle([&](std::span<const InputTriangle> triangles) {
      addPlaced(part, triangles, firstTexture, batch);
      return batch.failed() ? batch.finish().map([](const MeshCounts&) {}) : Result<>{};
    });
    if (!counts) return counts;
    for (const auto& [reason, count] : counts->skipped) before.skipped[reason] += count * part.placements.size();
    firstTexture += static_cast<uint32_t>(part.mesh->textures().size());
  }
  FARCELL_ASSIGN(MeshCounts counts, batch.finish());
  for (const auto& [reason, count] : before.skipped) counts.skipped[reason] += count;
  return counts;
}

}  // namespace

Result<std::unique_ptr<MeshReader>> composeMeshes(std::vector<ScenePart> parts, const SceneOptions& options) {
  FARCELL_CHECK(!parts.empty());
  MeshInfo info = parts[0].mesh->info();
  info.format = options.file.empty() ? "several files" : "scene";
  info.up = options.up.value_or(info.up);
  info.metresPerUnit = options.metresPerUnit.value_or(info.metresPerUnit);
  info.declaredTriangles = info.vertices = 0;
  for (const ScenePart& part : parts) {
    FARCELL_CHECK(!part.placements.empty());
    const MeshInfo& mesh = part.mesh->info();
    info.hasColours |= mesh.hasColours;
    info.hasNormals |= mesh.hasNormals;
    const uint64_t times = part.placements.size();
    if (!addProduct(info.declaredTriangles, mesh.declaredTriangles, times) ||
        !addProduct(info.vertices, mesh.vertices, times))
      return fail(ErrorKind::unsupported,
                  "{}: expected triangles and vertices that 64 bits can count, found {} times {}",
                  part.mesh->files()[0].string(), times, std::max(mesh.declaredTriangles, mesh.vertices));
  }
  return std::make_unique<SceneReader>(std::move(parts), options.file, std::move(info));
}

}  // namespace farcell
